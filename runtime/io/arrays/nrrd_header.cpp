// SPDX-License-Identifier: Apache-2.0
// The header of a NRRD file: its array, and where its cells are in space.
#include <algorithm>
#include <bit>
#include <cmath>

#include "runtime/base/text.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/nrrd_fields.hpp"
#include "runtime/io/mesh/companion_file.hpp"

namespace voxelume {
namespace {

CellType nrrd_type(const std::string& name, const InputFile& file) {
    struct Row {
        CellType type;
        std::vector<std::string_view> names;
    };
    static const std::vector<Row> rows = {
        {CellType::u8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
        {CellType::i8, {"signed char", "int8", "int8_t"}},
        {CellType::u16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
        {CellType::i16,
         {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
        {CellType::u32, {"uint", "unsigned int", "uint32", "uint32_t"}},
        {CellType::i32, {"int", "signed int", "int32", "int32_t"}},
        {CellType::u64,
         {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
        {CellType::i64,
         {"longlong", "long long", "long long int", "signed long long", "signed long long int",
          "int64", "int64_t"}},
        {CellType::f32, {"float"}},
        {CellType::f64, {"double"}}};
    for (const Row& row : rows)
        if (std::ranges::find(row.names, name) != row.names.end()) return row.type;
    file.refuse(fmt::format("its values are of the type {}, which isn't read", quote(name)));
}

DataEncoding nrrd_encoding(const std::string& name, const InputFile& file) {
    constexpr std::array<std::pair<std::string_view, DataEncoding>, 8> kNames = {
        {{"raw", DataEncoding::raw},
         {"gzip", DataEncoding::gzip},
         {"gz", DataEncoding::gzip},
         {"bzip2", DataEncoding::bzip2},
         {"bz2", DataEncoding::bzip2},
         {"text", DataEncoding::text},
         {"txt", DataEncoding::text},
         {"ascii", DataEncoding::text}}};
    for (const auto& [known, encoding] : kNames)
        if (name == known) return encoding;
    file.refuse(
        fmt::format("its encoding is {}; raw, gzip, bzip2 and text can be read: save it again as "
                    "one of them",
                    quote(name)));
}

/// True if the header says that the first axis is that of a colour, as in "RGB-color".
bool says_colors(const NrrdFields& fields) {
    const std::vector<std::string> kinds = fields.words("kinds");
    return !kinds.empty() && kinds[0].find("color") != std::string::npos;
}

/// Sets the counts and channels. Returns the number of the first axis of space.
size_t set_sizes(const NrrdFields& fields, const InputFile& file, CellArray& array) {
    const std::vector<double> sizes = fields.numbers("sizes"),
                              dimension = fields.numbers("dimension");
    if (dimension.size() != 1 || double(sizes.size()) != dimension[0])
        file.refuse(fmt::format("its header has {} sizes, and as its dimension \"{}\"",
                                sizes.size(), fields.text("dimension")));
    for (const double size : sizes)
        if (!(size >= 1 && size <= 1 << 20 && size == std::floor(size)))
            file.refuse(fmt::format("its sizes are {}; whole numbers to {} are possible",
                                    fields.text("sizes"), 1 << 20));
    const size_t axes = sizes.size();
    if (axes != 3 && axes != 4)
        file.refuse(fmt::format("it has {} axes; 3 of space are read, and one of colours", axes));
    size_t first = 0;
    if (axes == 4) {
        // The axis that isn't spatial is the one without a direction, or else the first.
        const std::vector<std::string> directions = fields.words("space directions");
        const bool is_last = directions.size() == 4 && directions[3] == "none";
        if (is_last && sizes[3] > 1)
            array.notes.push_back(fmt::format("the first of {} volumes", sizes[3]));
        if (!is_last) {
            first = 1;
            array.channels = int(sizes[0]);
            if (sizes[0] != 1 && sizes[0] != 3 && sizes[0] != 4)
                file.refuse(
                    fmt::format("its cells have {} values each; 1, or 3 and 4 for colours, "
                                "are read",
                                sizes[0]));
        }
    }
    for (size_t i = 0; i < 3; ++i) array.counts[int(i)] = int(sizes[first + i]);
    if (array.channels > 1 && !says_colors(fields))
        array.notes.push_back(
            fmt::format("assumed: the {} values of a cell are a colour", array.channels));
    return first;
}

/// Finds the file with the data and the byte at which they begin.
void set_data(const NrrdFields& fields, const InputFile& file, CellArray& array) {
    array.encoding = nrrd_encoding(fields.text("encoding"), file);
    if (array.encoding != DataEncoding::text && bytes_of(array.type) > 1) {
        const std::string endian = fields.text("endian");
        if (endian.empty()) file.refuse("its header lacks \"endian\"");
        array.is_swapped = endian == "big";
    }
    std::string name = fields.text("data file");
    if (name.empty()) name = fields.text("datafile");
    array.start = fields.end();
    if (!name.empty()) {
        if (name.find('%') != std::string::npos) NrrdFields::refuse_several(file);
        const auto found = companion_file(file.path(), name);
        if (!found)
            file.refuse(fmt::format("its data are in {}, which isn't in its folder", quote(name)));
        array.data = *found;
        array.start = 0;
    }
    if (fields.has("line skip") && fields.text("line skip") != "0")
        file.refuse("skips lines before its data, which isn't read; use \"byte skip\"");
    const std::vector<double> skip = fields.numbers("byte skip");
    if (skip.empty() || skip[0] == 0) return;
    const InputFile data(array.data);
    if (skip[0] == -1 && array.encoding == DataEncoding::raw)
        array.start = data.size() - std::min(data.size(), array.bytes());
    else if (skip[0] > 0 && skip[0] <= 1e9)
        (array.is_compressed() ? array.skip : array.start) += uint64_t(skip[0]);
    else
        file.refuse(fmt::format("can't skip {} bytes", fields.text("byte skip")));
}

/// The axes of a patient's space in the model's, whose directions are left, up and front.
struct Space {
    std::string_view name, short_name;
    glm::dvec3 x, y, z;
};

constexpr glm::dvec3 kLeft(1, 0, 0), kUp(0, 1, 0), kFront(0, 0, 1);

const Space* space_of(const std::string& name) {
    static const std::array<Space, 3> spaces = {
        {{"left-posterior-superior", "LPS", kLeft, -kFront, kUp},
         {"right-anterior-superior", "RAS", -kLeft, kFront, kUp},
         {"left-anterior-superior", "LAS", kLeft, kFront, kUp}}};
    for (const Space& space : spaces)
        if (name == space.name || name == space.short_name ||
            name == std::string(space.name) + "-time" ||
            name == std::string(space.short_name) + "T")
            return &space;
    return nullptr;
}

double metres_per_unit(const std::string& unit, bool is_patient, CellArray& array) {
    struct Row {
        std::string_view name;
        double metres;
    };
    constexpr std::array<Row, 9> kUnits = {{{"m", 1},
                                            {"cm", 1e-2},
                                            {"mm", 1e-3},
                                            {"um", 1e-6},
                                            {"\xc2\xb5m", 1e-6},
                                            {"micron", 1e-6},
                                            {"microns", 1e-6},
                                            {"nm", 1e-9},
                                            {"km", 1e3}}};
    for (const Row& row : kUnits)
        if (unit == row.name) return row.metres;
    if (is_patient) array.notes.emplace_back("assumed: lengths in millimetres");
    return is_patient ? 1e-3 : 1;
}

/// The map from indices to the file's space. Spacings and the corner serve where there are no
/// directions.
glm::dmat4 space_from_index(const NrrdFields& fields, size_t first, CellArray& array) {
    glm::dmat4 map(1);
    const std::vector<std::string> directions = fields.words("space directions");
    bool is_there = directions.size() >= first + 3;
    for (size_t i = 0; is_there && i < 3; ++i) {
        const auto direction = NrrdFields::vector(directions[first + i]);
        is_there = direction.has_value();
        if (direction) map[int(i)] = glm::dvec4(*direction, 0);
    }
    if (is_there) {
        const auto origin = NrrdFields::vector(fields.text("space origin"));
        map[3] = glm::dvec4(origin.value_or(glm::dvec3(0)), 1);
        return map;
    }
    map = glm::dmat4(1);
    const std::vector<double> spacings = fields.numbers("spacings"),
                              mins = fields.numbers("axis mins");
    bool is_guessed = false;
    for (size_t i = 0; i < 3; ++i) {
        const size_t axis = first + i;
        const bool has =
            axis < spacings.size() && std::isfinite(spacings[axis]) && spacings[axis] != 0;
        const double spacing = has ? std::abs(spacings[axis]) : 1;
        is_guessed |= !has;
        map[int(i)][int(i)] = spacing;
        const bool begins = axis < mins.size() && std::isfinite(mins[axis]);
        map[3][int(i)] = (begins ? mins[axis] : 0) + spacing / 2;
    }
    if (is_guessed) array.notes.emplace_back("assumed: cells 1 long, for the file has no spacing");
    return map;
}

/// The unit of all spatial axes.
std::string unit_of(const NrrdFields& fields, size_t first) {
    const std::vector<std::string> space = fields.words("space units"),
                                   axes = fields.words("units");
    if (!space.empty()) return space[0];
    return axes.size() > first ? axes[first] : std::string();
}

}  // namespace

bool is_volume_nrrd(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path)) return false;
    try {
        const InputFile file(path);
        std::array<char, 7> start{};
        if (file.size() < start.size()) return false;
        file.read(0, start.data(), start.size());
        if (std::string_view(start.data(), start.size()) != "NRRD000") return false;
        return NrrdFields(file).has_key("voxelume_frame");
    } catch (const Error&) {
        return false;  // the reader reports what is wrong
    }
}

CellArray read_nrrd_header(const std::filesystem::path& path) {
    const InputFile file(path);
    const NrrdFields fields(file);
    CellArray array;
    array.data = path;
    array.type = nrrd_type(fields.text("type"), file);
    const size_t first = set_sizes(fields, file, array);
    set_data(fields, file, array);
    check_array(array, InputFile(array.data));
    const Space* space = space_of(fields.text("space"));
    const double metres = metres_per_unit(unit_of(fields, first), space != nullptr, array);
    glm::dmat4 map = space_from_index(fields, first, array);
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 v = glm::dvec3(map[i]) * metres;
        map[i] = glm::dvec4(space ? v.x * space->x + v.y * space->y + v.z * space->z : v, i == 3);
    }
    array.orientation =
        space ? "the head is up, the face in front" : "x, y, z as in the file, with Y up";
    set_place(map, file, array);
    return array;
}

}  // namespace voxelume
