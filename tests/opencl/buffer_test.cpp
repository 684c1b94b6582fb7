// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

TEST(Buffer, GivesBackWhatWasWrittenToAPart) {
    Buffer<int> numbers(test_device(), "numbers", 7);
    numbers.fill(-1);
    numbers.write(std::vector<int>{10, 20, 30}, 2);
    EXPECT_EQ(numbers.read(), (std::vector<int>{-1, -1, 10, 20, 30, -1, -1}));
    EXPECT_EQ(numbers.read(3, 2), (std::vector<int>{20, 30}));
    EXPECT_EQ(numbers.read_one(4), 30);
}

TEST(Buffer, GivesBackMegabytesUnchanged) {
    std::vector<uint32_t> numbers(3'000'017);
    std::iota(numbers.begin(), numbers.end(), 5u);
    const Buffer<uint32_t> buffer(test_device(), "numbers", numbers);
    EXPECT_EQ(buffer.read(), numbers);
}

TEST(Buffer, ContentsOutliveTheBufferSmallOrLarge) {
    for (const size_t size : {size_t{5}, size_t{3'000'017}}) {
        std::vector<uint32_t> numbers(size);
        std::iota(numbers.begin(), numbers.end(), 7u);
        std::shared_ptr<uint32_t> contents;
        {
            const Device device = test_device();
            const Buffer<uint32_t> buffer(device, "numbers", numbers);
            contents = buffer.contents();
        }
        EXPECT_TRUE(std::equal(numbers.begin(), numbers.end(), contents.get())) << size;
    }
}

TEST(Buffer, AWriteIsSeenByTheNextKernelAndItsResultByTheNextRead) {
    const Device device = test_device();
    Kernel add = Program::from_text(device,
                                    "#include \"lib/lanes/work_item.h\"\n"
                                    "kernel void add(uint count, global uint* numbers) {\n"
                                    "    if (work_item() < count) numbers[work_item()] += 100;\n"
                                    "}\n")
                     .kernel("add");
    Buffer<uint32_t> numbers(device, "numbers", 3);
    for (uint32_t round = 0; round < 5; ++round) {
        numbers.write(std::vector<uint32_t>{round, 20, 30});
        add.launch(WorkItem::light, 3, 3u, numbers);
        EXPECT_EQ(numbers.read(), (std::vector<uint32_t>{round + 100, 120, 130}));
    }
}

TEST(Buffer, CopiesShareTheMemoryAndTheLastOneFreesIt) {
    const Device device = test_device();
    {
        Buffer<int> first(device, "shared", 1000);
        const Buffer<int> second = first;
        first.fill(42);
        EXPECT_EQ(second.read_one(999), 42);
        EXPECT_EQ(device.counters().bytes_in_use, 4000u);
    }
    EXPECT_EQ(device.counters().bytes_in_use, 0u);
    EXPECT_EQ(device.counters().peak_bytes, 4000u);
    EXPECT_EQ(device.counters().allocated_bytes.at("shared"), 4000u);
}

TEST(Buffer, AnEmptyOneTakesNoMemory) {
    const Device device = test_device();
    Buffer<int> nothing(device, "nothing", 0);
    nothing.fill(1);
    nothing.write({});
    EXPECT_TRUE(nothing.empty());
    EXPECT_TRUE(nothing.read().empty());
    EXPECT_TRUE(device.counters().allocated_bytes.empty());
}

TEST(Buffer, OneBeyondTheLargestAllocationIsRefusedBeforeMemoryIsTaken) {
    const Device device = test_device();
    const size_t size = device.info().max_allocation / 8 + 1;
    try {
        const Buffer<uint64_t> buffer(device, "voxels", size);
        FAIL() << "allocated";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
        EXPECT_NE(std::string(error.what()).find("the voxels buffer needs "), std::string::npos);
    }
    EXPECT_EQ(device.counters().bytes_in_use, 0u);
    EXPECT_TRUE(device.counters().allocated_bytes.empty());
}

TEST(Buffer, OfACountingDeviceTakesBytesAlone) {
    const Device device = Device::counting({});
    const DeviceCounters& counters = device.counters();
    {
        Buffer<int> small(device, "small", 100);
        const Buffer<uint64_t> vast(device, "vast", size_t{1} << 40);
        small.fill(1);
        small.write(std::vector<int>{1, 2, 3});
        EXPECT_EQ(small.size(), 100u);
        EXPECT_EQ(counters.bytes_in_use, (uint64_t{8} << 40) + 400);
    }
    EXPECT_EQ(counters.bytes_in_use, 0u);
    EXPECT_EQ(counters.peak_bytes, (uint64_t{8} << 40) + 400);
    EXPECT_EQ(counters.largest_buffer, "vast");
    EXPECT_EQ(counters.largest_bytes, uint64_t{8} << 40);
}

}  // namespace
}  // namespace voxelume
