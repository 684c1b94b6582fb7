// SPDX-License-Identifier: Apache-2.0
// Lane types: a kernel is written once and processes VXL_LANES rays in each work-item.
//
// With 16, 8 or 4 lanes a lane_float is a vector register of a CPU; with 1 it is a plain float,
// which is what a GPU runs. A mask is a lane_int of 0 (no) or -1 (yes) in every width.
//   LANE_MASK(a < b)            the mask of a comparison
//   LANES_SELECT(mask, a, b)    a where the mask says yes, else b
//   LANES_GATHER_UINT(p, index) p[index] lane by lane, likewise _FLOAT; all indices in range and
//                               below 2^31
//   LANES_LOAD(p, first)        p[first .. first + VXL_LANES)
//   LANES_STORE(value, p, first)
//   lanes_any(mask)             not 0 if any lane says yes; all lanes or-ed
//   lanes_min(v)              the smallest of the lanes' numbers
//   lanes_ranks(mask)           in each lane: how many lanes before it say yes
//   lanes_popcount(v)           bits set, lane by lane
//   LANES_INT, LANES_FLOAT, ... conversions (to int: towards zero)
#ifndef VXL_LANES_H
#define VXL_LANES_H

#pragma OPENCL FP_CONTRACT OFF

// INLINED marks functions at the bottom of most kernels' call trees. PoCL 3.1 copies a kernel's
// functions once for each chain of calls that leads to them, and without inlining there would be
// millions of chains through these functions. Where the optimizer runs, it inlines them by itself.
#if defined(__clang__) && !defined(__OPTIMIZE__) && !defined(OCLGRIND)
#define INLINED inline __attribute__((always_inline))
#else
#define INLINED inline
#endif

#define VXL_JOIN_(a, b) a##b
#define VXL_JOIN(a, b) VXL_JOIN_(a, b)

// The smaller of two numbers that are not NaN. This takes one instruction; fmin, which handles NaN,
// takes four.
#define LANES_LESS(a, b) LANES_SELECT(LANE_MASK((a) < (b)), a, b)

#if VXL_LANES == 1

typedef float lane_float;
typedef int lane_int;
typedef uint lane_uint;
typedef long lane_long;
#define LANE_MASK(condition) (-(int)(condition))
#define LANE_LONG_MASK(condition) LANE_MASK(condition)
#define LANES_SELECT(mask, yes, no) ((mask) ? (yes) : (no))
#define LANES_GATHER_UINT(p, index) ((p)[index])
#define LANES_GATHER_FLOAT(p, index) ((p)[index])
#define LANES_LOAD(p, first) ((p)[first])
#define LANES_STORE(value, p, first) ((p)[first] = (value))
#define LANES_INT(v) ((int)(v))
#define LANES_UINT(v) ((uint)(v))
#define LANES_FLOAT(v) ((float)(v))
#define LANES_LONG(v) ((long)(v))
#define LANES_SHORT(v) ((short)(v))
#define LANES_AS_INT(v) as_int(v)
#define LANES_AS_UINT(v) as_uint(v)
#define LANES_AS_FLOAT(v) as_float(v)
#define LANES_NUMBERS 0
#define LANES_FIRST(v) (v)

static inline int lanes_any(lane_int mask) {
    return mask;
}
static inline int lanes_count(lane_int mask) {
    return -mask;
}
static inline uint lanes_min(lane_uint v) {
    return v;
}
static inline lane_uint lanes_popcount(lane_uint v) {
    return popcount(v);
}
static inline lane_uint lanes_ranks(lane_int mask) {
    (void)mask;
    return 0;
}

#else

typedef VXL_JOIN(float, VXL_LANES) lane_float;
typedef VXL_JOIN(int, VXL_LANES) lane_int;
typedef VXL_JOIN(uint, VXL_LANES) lane_uint;
typedef VXL_JOIN(long, VXL_LANES) lane_long;
#define LANE_MASK(condition) (condition)
#define LANE_LONG_MASK(condition) VXL_JOIN(convert_int, VXL_LANES)(condition)
#define LANES_SELECT(mask, yes, no) select(no, yes, mask)
#define LANES_LOAD(p, first) VXL_JOIN(vload, VXL_LANES)(0, (p) + (first))
#define LANES_STORE(value, p, first) VXL_JOIN(vstore, VXL_LANES)(value, 0, (p) + (first))
#define LANES_INT(v) VXL_JOIN(convert_int, VXL_LANES)(v)
#define LANES_UINT(v) VXL_JOIN(convert_uint, VXL_LANES)(v)
#define LANES_FLOAT(v) VXL_JOIN(convert_float, VXL_LANES)(v)
#define LANES_LONG(v) VXL_JOIN(convert_long, VXL_LANES)(v)
#define LANES_SHORT(v) VXL_JOIN(convert_short, VXL_LANES)(v)
#define LANES_AS_INT(v) VXL_JOIN(as_int, VXL_LANES)(v)
#define LANES_AS_UINT(v) VXL_JOIN(as_uint, VXL_LANES)(v)
#define LANES_AS_FLOAT(v) VXL_JOIN(as_float, VXL_LANES)(v)
#define LANES_FIRST(v) ((v).s0)

// Indexed loads in this form become one gather instruction. `any` on a vector would compile to a
// chain of branches; folding halves does not.
#if VXL_LANES == 4
#define VXL_INDEXED(p, i) (p)[(i).s0], (p)[(i).s1], (p)[(i).s2], (p)[(i).s3]
#define LANES_NUMBERS ((int4)(0, 1, 2, 3))
static inline int lanes_any(int4 mask) {
    int2 q = mask.lo | mask.hi;
    return q.x | q.y;
}
static inline int lanes_count(int4 mask) {
    return (int)popcount(as_uint(convert_char4(mask))) >> 3;
}
static inline uint lanes_min(uint4 v) {
    uint2 q = min(v.lo, v.hi);
    return min(q.x, q.y);
}
static inline uint lanes_all_bits(uint4 v) {
    uint2 q = v.lo | v.hi;
    return q.x | q.y;
}
#elif VXL_LANES == 8
#define VXL_INDEXED(p, i)                                                                      \
    (p)[(i).s0], (p)[(i).s1], (p)[(i).s2], (p)[(i).s3], (p)[(i).s4], (p)[(i).s5], (p)[(i).s6], \
        (p)[(i).s7]
#define LANES_NUMBERS ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
static inline int lanes_any(int8 mask) {
    int4 h = mask.lo | mask.hi;
    int2 q = h.lo | h.hi;
    return q.x | q.y;
}
static inline int lanes_count(int8 mask) {
    return (int)popcount(as_ulong(convert_char8(mask))) >> 3;
}
static inline uint lanes_min(uint8 v) {
    uint4 h = min(v.lo, v.hi);
    uint2 q = min(h.lo, h.hi);
    return min(q.x, q.y);
}
static inline uint lanes_all_bits(uint8 v) {
    uint4 h = v.lo | v.hi;
    uint2 q = h.lo | h.hi;
    return q.x | q.y;
}
#else
#define VXL_INDEXED(p, i)                                                                          \
    (p)[(i).s0], (p)[(i).s1], (p)[(i).s2], (p)[(i).s3], (p)[(i).s4], (p)[(i).s5], (p)[(i).s6],     \
        (p)[(i).s7], (p)[(i).s8], (p)[(i).s9], (p)[(i).sa], (p)[(i).sb], (p)[(i).sc], (p)[(i).sd], \
        (p)[(i).se], (p)[(i).sf]
#define LANES_NUMBERS ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
static inline int lanes_any(int16 mask) {
    int8 e = mask.lo | mask.hi;
    int4 h = e.lo | e.hi;
    int2 q = h.lo | h.hi;
    return q.x | q.y;
}
static inline int lanes_count(int16 mask) {
    const ulong2 bytes = as_ulong2(convert_char16(mask));
    return (int)(popcount(bytes.x) + popcount(bytes.y)) >> 3;
}
static inline uint lanes_min(uint16 v) {
    uint8 e = min(v.lo, v.hi);
    uint4 h = min(e.lo, e.hi);
    uint2 q = min(h.lo, h.hi);
    return min(q.x, q.y);
}
static inline uint lanes_all_bits(uint16 v) {
    uint8 e = v.lo | v.hi;
    uint4 h = e.lo | e.hi;
    uint2 q = h.lo | h.hi;
    return q.x | q.y;
}
#endif

/// The number of bits set in each lane. PoCL's popcount of a vector works lane by lane.
static inline lane_uint lanes_popcount(lane_uint v) {
    v -= (v >> 1) & 0x55555555u;
    v = (v & 0x33333333u) + ((v >> 2) & 0x33333333u);
    v = (v + (v >> 4)) & 0x0F0F0F0Fu;
    v += v >> 8;
    return (v + (v >> 16)) & 0x3Fu;
}

static inline lane_uint lanes_ranks(lane_int mask) {
    const lane_uint own = (lane_uint)1u << LANES_AS_UINT(LANES_NUMBERS);
    return lanes_popcount((lane_uint)lanes_all_bits(LANES_AS_UINT(mask) & own) & (own - 1u));
}

// Indices are read as signed: a gather with unsigned ones becomes two gathers with 64-bit
// addresses.
#define LANES_GATHER_UINT(p, i) ((lane_uint)(VXL_INDEXED(p, LANES_AS_INT(i))))
#define LANES_GATHER_FLOAT(p, i) ((lane_float)(VXL_INDEXED(p, LANES_AS_INT(i))))
#endif

#endif
