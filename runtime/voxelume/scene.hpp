// SPDX-License-Identifier: Apache-2.0
// A scene: read from a file or text, or built from plain structs; checked once, then immutable.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "animation.hpp"
#include "lights.hpp"
#include "objects.hpp"
#include "observer.hpp"
#include "process.hpp"
#include "world.hpp"

namespace voxelume::v1 {

/// Everything that a scene file says, as plain structs. Lengths are metres, angles degrees, colours
/// linear Rec. 709; axes are right-handed with Y up. Defaults and ranges are those of the scene
/// format.
struct SceneDescription {
    std::string name = "scene";         ///< name in messages
    World world{};                      ///< the lattice, and the environment
    std::vector<Material> materials{};  ///< materials, to which objects refer
    std::vector<Model> models{};        ///< models, to which objects refer
    std::vector<Object> objects{};      ///< models placed in the world
    /// Lights. Without a value, and without an emissive material, one light comes from over the
    /// observer's left shoulder; with an empty list there is none.
    std::optional<std::vector<Light>> lights{};
    /// The observer and its display; without a value an observer who sees all objects, from the
    /// right of the front and from above.
    std::optional<Observer> observer{};
    Animation animation{};    ///< frames, and the tracks that change them
    RenderSettings render{};  ///< the flat image
};

/// A value that replaces one of a scene's, or is added to it, before the scene is read and checked.
struct SceneChange {
    /// The path to the value by the keys of the scene format, as in tracks:
    /// "objects.ball.position". Items of lists are named by their names or their indices,
    /// "lights[0]" or "lights.0". Keys that the scene lacks are added; new models and materials are
    /// added if the path ends at their name.
    std::string path{};
    /// JSON; or numbers separated by commas, which are a list; or a text without quotes.
    std::string value{};
    /// The change in messages: "--set objects.ball.position=0,1,0"; empty: its path.
    std::string origin{};
};

/// The folders of a scene's files, and changes of its values.
struct SceneOptions {
    /// Folders in which files that the scene names are looked for, after the scene's own and before
    /// those of the environment variable VOXELUME_ASSETS. Files must lie below these folders.
    std::vector<std::filesystem::path> assets{};
    /// The cache of known models to which the scene is fitted. Rendering with the same options uses
    /// files that were read for fitting, once.
    CacheOptions cache{};
    /// Values to be changed, one after the other. A mistake in one is Error::usage, whose sentence
    /// begins with the change's origin.
    std::vector<SceneChange> changes{};
    /// False for a text that a program made: messages then name keys alone, not lines.
    bool has_lines = true;
    /// Voxels in memory that models name in place of files; they are read while the scene is made.
    /// Throws Error::usage for two arrays of one name, for zero or negative sizes, and for arrays
    /// without a voxel, Error::limit for more voxels than a model may have.
    std::vector<VoxelArray> voxels{};
    /// Degrees by which the observer moves to the right, around a vertical axis through the point
    /// that it looks at, or through the middle of the world without such a point. Throws
    /// Error::usage for an observer that moves.
    double orbit = 0;
};

/// A scene that was checked. Copies share their values and are cheap; any number of threads may use
/// one scene.
class Scene {
  public:
    /// Reads a scene file (JSON; scenes/README.md describes it).
    ///
    /// Throws Error::scene with file, line, column and key for text or values that are wrong,
    /// Error::input for a scene or a file that it names that is missing, or one that the scene is
    /// fitted to that can't be read, Error::limit for a file of more than 64 MiB.
    static Scene load(const std::filesystem::path& file, const SceneOptions& options = {});

    /// Reads the text of a scene. `file` names it in messages, and its folder is the first in which
    /// the scene's files are looked for; there need not be such a file.
    static Scene parse(std::string_view text, const std::filesystem::path& file = "scene",
                       const SceneOptions& options = {});

    /// Checks plain structs as a file's values are checked. Throws what `load` throws; an Error has
    /// the description's name as its file, and a key such as "objects[0].material", but no line.
    static Scene build(const SceneDescription& description, const SceneOptions& options = {});

    /// Returns the scene with another image size, as a whole picture; the angles of a display with
    /// square pixels follow, and so does a fitted observer.
    Scene with_size(Size size) const;
    /// Returns the scene with a part of its flat image as the image: `size` pixels from column and
    /// row `first` on, counted from 0 at the top left. The bits are those of the whole image there;
    /// OpenEXR files have the part as their data window. Volumetric images stay whole. Throws
    /// Error::usage for a part that isn't in the image; and, of a scene with a target of noise, for
    /// one that doesn't begin and end at multiples of 4 pixels or at the image's edge.
    Scene with_crop(Size first, Size size) const;
    /// Returns the scene with another number of sight rays a pixel, 1..4096.
    Scene with_samples(int samples) const;

    /// Returns the scene with as many samples as its images need: the samples of each 4 x 4 pixels,
    /// or 16 voxels of a volumetric image, are doubled, from 16 to at most `max_samples`, until
    /// their standard error is at most `error` times their mean light. The error is estimated as
    /// half of the difference between two halves of the samples. With `seconds` above 0 samples are
    /// only doubled if the image's time suffices, of which a volumetric image that is rendered with
    /// it gets half; and an `error` of 0 is never reached. Throws Error::usage for numbers below 0,
    /// for two zeros, for samples that aren't from 32 to 4096, and for a part of an image that
    /// `with_crop` refuses with them.
    Scene with_noise(double error, double seconds = 0, int max_samples = 4096) const;

    /// Returns the scene in another light.
    Scene with_light(LightMode light) const;

    /// The file from which the scene was read; empty for a scene that was built.
    const std::filesystem::path& file() const;
    /// Width and height of the scene's image, pixels.
    Size size() const;
    double pixel_aspect() const;  ///< width of the image's pixels over their height
    bool moves() const;           ///< true if any frame may differ from another
    int frames() const;           ///< number of frames of the animation; 1 without one
    /// Frames per second of the scene's animation.
    double frames_per_second() const;
    /// Names of the objects, in the order of their numbers in images, from 1 on.
    std::vector<std::string> object_names() const;
    /// The parts that the scene leaves out and that were found from its objects: members of a scene
    /// file, a line each; empty if there are none.
    std::string fitted() const;
    /// True if the scene's only light is the default one of scenes without a key for lights.
    bool has_default_light() const;
    /// A description of the scene in lines for people.
    std::string describe() const;

    struct Implementation;
    /// For the library's own use.
    explicit Scene(std::shared_ptr<const Implementation> implementation)
        : implementation_(std::move(implementation)) {}
    /// For the library's own use.
    const Implementation& implementation() const { return *implementation_; }

  private:
    std::shared_ptr<const Implementation> implementation_;
};

}  // namespace voxelume::v1
