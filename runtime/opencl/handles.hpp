// SPDX-License-Identifier: Apache-2.0
// The names of OpenCL's C++ types, for headers. Only the sources in this folder include
// CL/opencl.hpp, which takes half a second to read.
#pragma once

namespace cl {

class Buffer;
class CommandQueue;
class Context;
class Device;
class Error;
class Kernel;
class NDRange;
class Program;

}  // namespace cl
