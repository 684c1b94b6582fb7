// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any text of a scene gives a scene and its frames, or an error's sentence.
#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/fuzz/refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace voxelume;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    check_refusal("/nowhere/", [&] {
        AssetStore assets;
        const Scene scene = parse_scene(
            text, "/nowhere/fuzz.json", {},
            [&](const Model& model, bool keeps) { return assets.box_of_file(model, keeps); });
        for (const double frame : {0.0, 1.0, 2.5, 1e6}) scene_at(scene, frame);
    });
    return 0;
}
