// Closes an object that threads share at the end of a block, by whatever way control leaves it.
#pragma once

namespace voxelume {

/// Calls `close()` on an object when it is destroyed.
template <class Shared>
class Closing {
  public:
    explicit Closing(Shared& shared) : shared_(shared) {}
    ~Closing() { shared_.close(); }
    Closing(const Closing&) = delete;
    Closing& operator=(const Closing&) = delete;

  private:
    Shared& shared_;
};

}  // namespace voxelume
