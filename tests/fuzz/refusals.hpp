// SPDX-License-Identifier: Apache-2.0
// Checks the errors with which readers refuse a fuzz target's inputs.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "runtime/base/error.hpp"

namespace voxelume {

[[noreturn]] inline void fail_fuzzing(const char* what, const std::string& text) {
    std::fprintf(stderr, "%s: %s\n", what, text.c_str());
    std::abort();
}

/// Runs the action, and stops the fuzzer if an error's text doesn't begin with the file's name.
template <class Action>
void check_refusal(const std::string& file, const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        const std::string sentence = error.what();
        if (!sentence.starts_with(file)) fail_fuzzing("no file in front of", sentence);
    }
}

}  // namespace voxelume
