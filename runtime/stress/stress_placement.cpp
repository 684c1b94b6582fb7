#include "runtime/stress/stress_placement.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/stages/place.hpp"
#include "runtime/stress/device_walks.hpp"
#include "runtime/stress/stress_random.hpp"

namespace voxelume {
namespace {

using Exact = long double;
using ExactVector = glm::vec<3, Exact>;
using ExactMatrix = glm::mat<3, 3, Exact>;

const GridFrame kWorld{.origin = {-20, -18, -21}, .voxel_edge = {1, 1, 1}, .size = {45, 39, 51}};
const GridFrame kObject{.origin = {-8, -5, -7}, .voxel_edge = {1, 1, 1}, .size = {17, 12, 15}};

VoxelBits random_lump(uint64_t seed) {
    VoxelBits lump(kObject.size);
    StressRandom random(seed, 300, 0);
    for (glm::ivec3 v{0}; v.z < kObject.size.z; ++v.z)
        for (v.y = 0; v.y < kObject.size.y; ++v.y)
            for (v.x = 0; v.x < kObject.size.x; ++v.x)
                if (random.below(3) != 0) lump.set(v);
    return lump;
}

/// One of the 48 turns and mirrors of a cube, times powers of two.
StressMap quarter_turns(StressRandom& random) {
    int axes[3] = {0, 1, 2};
    std::swap(axes[0], axes[random.below(3)]);
    std::swap(axes[1], axes[1 + random.below(2)]);
    StressMap map;
    map.is_exact = true;
    map.world_from_object = glm::dmat4(0.0);
    for (int a = 0; a < 3; ++a) {
        map.world_from_object[a][axes[a]] = random.sign() * double(1 << random.below(2));
        map.world_from_object[3][a] = double(random.between(-20, 20)) / 4;
    }
    map.world_from_object[3][3] = 1;
    return map;
}

/// A turn by a quaternion of small integers, then anything else that an affine map can do.
StressMap any_map(StressRandom& random) {
    glm::dvec4 q(0);
    while (q == glm::dvec4(0))
        for (int i = 0; i < 4; ++i) q[i] = double(random.between(-5, 5));
    const double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    const glm::dmat3 turn = glm::dmat3(n - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.z * q.w),
                                       2 * (q.x * q.z - q.y * q.w), 2 * (q.x * q.y - q.z * q.w),
                                       n - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.x * q.w),
                                       2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w),
                                       n - 2 * (q.x * q.x + q.y * q.y)) /
                            n;
    glm::dmat3 stretch(0.0);
    for (int a = 0; a < 3; ++a) stretch[a][a] = random.sign() * random.uniform(1.8, 2.6);
    stretch[1][0] = random.uniform(-0.3, 0.3);
    StressMap map;
    map.world_from_object = glm::dmat4(turn * stretch);
    for (int a = 0; a < 3; ++a) map.world_from_object[3][a] = random.uniform(-5, 5);
    return map;
}

/// The object voxel that a world voxel's centre falls in, and how far it is from being in another.
struct Image {
    ExactMatrix linear;
    ExactVector offset;

    explicit Image(const glm::dmat4& world_from_object) {
        linear = glm::inverse(ExactMatrix(glm::dmat3(world_from_object)));
        offset =
            -linear * ExactVector(glm::dvec3(world_from_object[3])) - ExactVector(kObject.origin);
    }
    ExactVector of_centre(const glm::ivec3& v) const {
        return linear * (ExactVector(kWorld.origin) + ExactVector(v) + Exact(0.5)) + offset;
    }
};

bool is_set(const VoxelBits& voxels, const glm::ivec3& v) {
    return glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) &&
           glm::all(glm::lessThan(v, voxels.size())) && voxels.is_set(v);
}

/// Whether any of the voxels that a point may lie in, when moved by up to `bound`, is set or not.
void look_around(const VoxelBits& lump, const ExactVector& p, Exact bound, bool& may_be_set,
                 bool& may_be_empty) {
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 v;
        for (int a = 0; a < 3; ++a)
            v[a] = int(std::floor(p[a] + (corner >> a & 1 ? bound : -bound)));
        (is_set(lump, v) ? may_be_set : may_be_empty) = true;
    }
}

/// A world's occupancy, read back.
class WorldVoxels {
  public:
    explicit WorldVoxels(const BrickGrid& grid)
        : bricks_(grid.frame.bricks()), slots_(grid.slots.read()), masks_(grid.occupancy.read()) {}

    bool is_set(const glm::ivec3& v) const {
        const glm::ivec3 b = v / 16, leaf = v % 16 / 4, in = v % 4;
        const uint32_t slot = slots_[size_t(b.x + bricks_.x * (b.y + bricks_.y * b.z))];
        if (slot >= kBrickInside) return slot == kBrickInside;
        return masks_[64 * size_t(slot) + size_t(leaf.x + 4 * leaf.y + 16 * leaf.z)] >>
                   (in.x + 4 * in.y + 16 * in.z) &
               1;
    }

  private:
    glm::ivec3 bricks_;
    std::vector<uint32_t> slots_;
    std::vector<uint64_t> masks_;
};

std::string text_of(const glm::dmat4& m) {
    std::string text = "columns";
    for (int c = 0; c < 4; ++c) text += fmt::format(" ({},{},{})", m[c][0], m[c][1], m[c][2]);
    return text;
}

}  // namespace

StressMap stress_map(uint64_t seed, uint64_t number) {
    StressRandom random(seed, 301, number);
    return number % 2 == 0 ? quarter_turns(random) : any_map(random);
}

StressResult stress_placement(const StressRun& run) {
    const VoxelBits lump = random_lump(run.seed);
    const BrickGrid grid = cubes_of(run.device, lump, kObject);
    // Coefficients and offsets are rounded to 2^-24: half of that for each of the world's steps.
    const Exact rounding = std::ldexp(Exact(1 + 45 + 39 + 51), -25);
    StressResult result;
    for (uint64_t number = run.first; number < run.first + run.count; ++number) {
        const StressMap map = stress_map(run.seed, number);
        const PlacedObject object{
            .grid = &grid, .world_from_object = map.world_from_object, .material_of_group = {0}};
        const WorldVoxels placed(place(run.device, {&object, 1}, kWorld));
        const Image image(map.world_from_object);
        std::atomic<uint64_t> wrong{0};
        for_each_in_parallel(uint64_t(kWorld.size.z), [&](uint64_t z) {
            for (glm::ivec3 v(0, 0, int(z)); v.y < kWorld.size.y; ++v.y)
                for (v.x = 0; v.x < kWorld.size.x; ++v.x) {
                    bool may_be_set = false, may_be_empty = false;
                    look_around(lump, image.of_centre(v), map.is_exact ? 0 : rounding, may_be_set,
                                may_be_empty);
                    wrong += !(placed.is_set(v) ? may_be_set : may_be_empty);
                }
        });
        result.cells += uint64_t(kWorld.size.x) * uint64_t(kWorld.size.y) * uint64_t(kWorld.size.z);
        if (wrong > 0)
            note_mismatch(result, number, [&] {
                return fmt::format("{}: {} voxels are wrong", text_of(map.world_from_object),
                                   wrong.load());
            });
        ++result.cases;
        if (run.advance) run.advance(1);
    }
    return result;
}

}  // namespace voxelume
