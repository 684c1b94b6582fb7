// SPDX-License-Identifier: Apache-2.0
// OpenEXR's output stream onto an AtomicFile. OpenEXR 3.1.5's own stream truncates small files
// silently on a full disk.
#pragma once

#include <ImfIO.h>

#include <string>

#include "runtime/base/files/atomic_file.hpp"

namespace voxelume {

class ExrStream : public Imf::OStream {
  public:
    ExrStream(AtomicFile& file, const std::string& name) : OStream(name.c_str()), file_(file) {}
    void write(const char bytes[], int count) override {
        file_.write(bytes, static_cast<size_t>(count));
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

  private:
    AtomicFile& file_;
};

}  // namespace voxelume
