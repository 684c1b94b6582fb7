// Closes what threads share at the end of a block, however it is left.
#pragma once

namespace voxelume {

/// Calls `close()` when it goes.
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
