// SPDX-License-Identifier: Apache-2.0
// Flat images for Python: planes as arrays over the library's memory.
#include <algorithm>
#include <array>

#include "bindings.hpp"

namespace voxelume_python {
namespace {

using voxelume::Image;

std::vector<py::ssize_t> shape_of(const Image& image) {
    return {image.height(), image.width()};
}

py::array plane(const py::object& self, const std::string& channel) {
    const auto& image = self.cast<const Image&>();
    if (channel == "materialId" && !image.material_ids().empty())
        return view(image.material_ids().data(), shape_of(image), self);
    if (channel == "objectId" && !image.object_ids().empty())
        return view(image.object_ids().data(), shape_of(image), self);
    if (!image.has(channel)) throw py::key_error(channel);
    return view(image.plane(channel).data(), shape_of(image), self);
}

py::array_t<float> rgba(const Image& image) {
    py::array_t<float> result(std::vector<py::ssize_t>{image.height(), image.width(), 4});
    float* out = result.mutable_data();
    size_t component = 0;
    for (const char* name : {"R", "G", "B", "A"}) {
        const auto plane = image.has(name) ? image.plane(name) : std::span<const float>();
        if (plane.empty() && name[0] != 'A') throw py::key_error(name);
        for (size_t i = 0; i < size_t(image.width()) * size_t(image.height()); ++i)
            out[4 * i + component] = plane.empty() ? 1.0f : plane[i];
        ++component;
    }
    return result;
}

py::dict difference(const Image& a, const Image& b) {
    voxelume::ImageDifference found;
    {
        const py::gil_scoped_release release;
        found = voxelume::compare(a, b);
    }
    py::dict channels;
    for (const voxelume::ChannelDifference& c : found.channels)
        channels[py::str(c.channel)] =
            py::dict(py::arg("max") = c.max, py::arg("rmse") = c.rmse, py::arg("mae") = c.mae,
                     py::arg("mrse") = c.mrse, py::arg("differing") = c.differing,
                     py::arg("unmatched") = c.unmatched, py::arg("is_id") = c.is_id);
    return py::dict(py::arg("channels") = channels, py::arg("only_in_a") = found.only_in_a,
                    py::arg("only_in_b") = found.only_in_b, py::arg("flip") = found.flip);
}

std::vector<std::string> channels_of(const Image& image) {
    std::vector<std::string> names = image.channels();
    if (!image.object_ids().empty()) names.emplace_back("objectId");
    if (!image.material_ids().empty()) names.emplace_back("materialId");
    return names;
}

/// The groups of channels for which an image has planes.
voxelume::Channels groups_of(const Image& image) {
    const std::vector<std::string> names = channels_of(image);
    voxelume::Channels channels = voxelume::kNoChannels;
    for (const voxelume::ChannelRow& row : voxelume::channel_table())
        channels.*row.member = std::ranges::any_of(row.planes, [&](const std::string_view plane) {
            return std::ranges::any_of(names, [&](const std::string& name) {
                return plane.ends_with('_') ? name.starts_with(plane) : name == plane;
            });
        });
    return channels;
}

voxelume::ViewTransform transform_named(const std::string& name) {
    using voxelume::ViewTransform;
    constexpr std::array kNames = {
        std::pair{"srgb", ViewTransform::srgb}, std::pair{"none", ViewTransform::none},
        std::pair{"filmic", ViewTransform::filmic}, std::pair{"agx", ViewTransform::agx}};
    for (const auto& [known, transform] : kNames)
        if (name == known) return transform;
    throw voxelume::Error(
        voxelume::ErrorKind::usage,
        "no view transform is named \"" + name + "\": there are srgb, none, filmic and agx");
}

void write(const Image& image, const std::filesystem::path& file, double exposure,
           const std::string& view_transform, int png_bits, bool float_color, bool multi_part,
           const std::optional<std::vector<std::string>>& channels) {
    image.write(file, {.exposure = exposure,
                       .view_transform = transform_named(view_transform),
                       .png_bits = png_bits,
                       .float_color = float_color,
                       .channels = channels ? channels_named(*channels) : groups_of(image),
                       .multi_part = multi_part});
}

}  // namespace

void bind_images(py::module_& module) {
    py::class_<Image>(module, "Image",
                      "An image: planes of height x width values, row 0 at the top.\n\n"
                      "`image[\"Z\"]` is a channel as a read-only array over the image's memory; "
                      "it keeps the image alive.")
        .def_static("read", &Image::read, py::arg("file"), py::call_guard<py::gil_scoped_release>(),
                    "Reads an OpenEXR or PNG file.")
        .def_property_readonly("width", &Image::width, "pixels along a row")
        .def_property_readonly("height", &Image::height, "rows")
        .def_property_readonly("holds_codes", &Image::holds_codes,
                               "whether values are sRGB codes of a PNG file, not light")
        .def_property_readonly("channels", &channels_of, "names of the channels")
        .def_property_readonly(
            "rgba", &rgba,
            "the colour as a new array (height, width, 4): linear Rec. 709, multiplied by A")
        .def("__getitem__", &plane, py::arg("channel"))
        .def(
            "__contains__",
            [](const Image& image, const std::string& channel) {
                return std::ranges::count(channels_of(image), channel) > 0;
            },
            py::arg("channel"))
        .def(
            "write", &write, py::arg("file"), py::kw_only(), py::arg("exposure") = 0.0,
            py::arg("view_transform") = "srgb", py::arg("png_bits") = 8,
            py::arg("float_color") = false, py::arg("multi_part") = false,
            py::arg("channels") = std::nullopt, py::call_guard<py::gil_scoped_release>(),
            "Writes an OpenEXR or PNG file, by the ending of its name, whole or not at all.\n\n"
            "A PNG file shows light multiplied by 2^`exposure` by the `view_transform` srgb, none, "
            "filmic or agx, in 8 or 16 bits a channel. "
            "An OpenEXR file has all channels of the image, or those of `channels`, named as "
            "for `render`, with `multi_part` each layer as a part of its own.")
        .def("__repr__", [](const Image& image) {
            return "<voxelume.Image of " + std::to_string(image.width()) + " x " +
                   std::to_string(image.height()) + " pixels>";
        });
    module.def("compare", &difference, py::arg("a"), py::arg("b"),
               "How far image `a` is from the reference `b`, by channel, and FLIP.");
}

}  // namespace voxelume_python
