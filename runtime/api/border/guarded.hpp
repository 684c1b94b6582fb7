// SPDX-License-Identifier: Apache-2.0
// The border of the library: errors of its inside -> the error that callers know.
#pragma once

#include <exception>
#include <functional>
#include <new>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/voxelume/error.hpp"

namespace voxelume::api {

/// An exception of a caller's callback, on its way through the library.
struct CallerException {
    std::exception_ptr exception;
};

/// An engine's error as the type that callers catch.
v1::Error error_for_callers(const Error& error);

/// Calls the body of a library function and rethrows its errors as callers know them.
template <class Action>
auto guarded(const Action& action) -> decltype(action()) {
    try {
        return action();
    } catch (const CallerException& caller) {
        std::rethrow_exception(caller.exception);
    } catch (const Error& error) {
        throw error_for_callers(error);
    } catch (const v1::Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw v1::Error(v1::ErrorKind::limit,
                        "out of memory: use fewer or larger voxels, or a smaller picture");
    } catch (const std::exception& error) {
        throw v1::Error(v1::ErrorKind::render, error.what());
    }
}

/// A caller's callback, for the library's inside: what it throws arrives at the caller as it is. It
/// is empty if the caller's is.
template <class... Args>
std::function<void(Args...)> callback(const std::function<void(Args...)>& of_caller) {
    if (!of_caller) return {};
    return [&of_caller](Args... args) {
        try {
            of_caller(std::forward<Args>(args)...);
        } catch (...) {
            throw CallerException{std::current_exception()};
        }
    };
}

}  // namespace voxelume::api
