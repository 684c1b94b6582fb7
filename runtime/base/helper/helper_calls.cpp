// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/helper/helper_calls.hpp"

#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

#include "runtime/base/sanitizers.hpp"

namespace voxelume {
namespace {

constexpr int kAllowed[] = {
    SCMP_SYS(read),           SCMP_SYS(readv),        SCMP_SYS(pread64),
    SCMP_SYS(write),          SCMP_SYS(writev),       SCMP_SYS(lseek),
    SCMP_SYS(close),          SCMP_SYS(fstat),        SCMP_SYS(brk),
    SCMP_SYS(munmap),         SCMP_SYS(mremap),       SCMP_SYS(madvise),
    SCMP_SYS(futex),          SCMP_SYS(sched_yield),  SCMP_SYS(sched_getaffinity),
    SCMP_SYS(getpid),         SCMP_SYS(gettid),       SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack),
    SCMP_SYS(clock_gettime),  SCMP_SYS(gettimeofday), SCMP_SYS(clock_nanosleep),
    SCMP_SYS(getrandom),      SCMP_SYS(getrlimit),    SCMP_SYS(setrlimit),
    SCMP_SYS(exit),           SCMP_SYS(exit_group),   SCMP_SYS(rseq),
    SCMP_SYS(set_robust_list)};

/// Calls that are allowed if what they are given has this value where `mask` is set.
struct Allowed {
    int call;
    unsigned argument;
    scmp_datum_t mask, value;
};

bool add_rules(scmp_filter_ctx filter) {
    const auto self = scmp_datum_t(getpid());
    const Allowed with_arguments[] = {
        {SCMP_SYS(mmap), 2, PROT_EXEC, 0},
        {SCMP_SYS(mprotect), 2, PROT_EXEC, 0},
        {SCMP_SYS(newfstatat), 3, AT_EMPTY_PATH, AT_EMPTY_PATH},  // fstat of newer C libraries
        {SCMP_SYS(clone), 0, CLONE_THREAD, CLONE_THREAD},
        {SCMP_SYS(prlimit64), 0, ~scmp_datum_t{0}, 0},  // of this process
        {SCMP_SYS(tgkill), 0, ~scmp_datum_t{0}, self},  // abort()
    };
    // The flags of clone3 can't be seen here. The C library tries clone where there is no clone3.
    if (seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) != 0) return false;
    for (const int call : kAllowed)
        if (seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) != 0) return false;
    for (const Allowed& rule : with_arguments) {
        const scmp_arg_cmp is_value = {rule.argument, SCMP_CMP_MASKED_EQ, rule.mask, rule.value};
        if (seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, rule.call, 1, &is_value) != 0)
            return false;
    }
    return true;
}

}  // namespace

bool forbid_system_calls() {
    if (kHasSanitizer) return false;
    const std::unique_ptr<void, decltype(&seccomp_release)> filter(
        seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
    if (!filter || !add_rules(filter.get())) return false;
    // Threads that run already are filtered, too.
    return seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1) == 0 &&
           seccomp_load(filter.get()) == 0;
}

}  // namespace voxelume
