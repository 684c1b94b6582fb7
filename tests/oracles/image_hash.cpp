#include "tests/oracles/image_hash.hpp"

namespace oracle {
namespace {

class Fnv {
  public:
    void add(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001B3u;
    }
    uint64_t value() const { return hash_; }

  private:
    uint64_t hash_ = 0xCBF29CE484222325u;
};

template <class Planes>
void add_planes(const Planes& planes, Fnv& hash) {
    for (const auto& [name, values] : planes) {
        hash.add(name.data(), name.size());
        hash.add(values.data(), values.size() * sizeof(values[0]));
    }
}

}  // namespace

uint64_t image_hash(const voxelume::Image& image) {
    Fnv hash;
    hash.add(&image.width, sizeof image.width);
    hash.add(&image.height, sizeof image.height);
    add_planes(image.planes, hash);
    add_planes(image.id_planes, hash);
    return hash.value();
}

}  // namespace oracle
