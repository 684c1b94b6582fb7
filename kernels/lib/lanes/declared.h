// SPDX-License-Identifier: Apache-2.0
// The types and functions of OpenCL C that the kernels use, declared here for PoCL.
//
// PoCL reads 17,000 declarations before each program, which takes 80 ms. With _OPENCL_H_ defined,
// it skips them, and the host puts this text in front of the kernels instead. A kernel that uses a
// function which isn't declared here is compiled with all declarations, as on every other driver.
// The attributes are those that clang's own header gives these functions.
#ifndef VXL_DECLARED_H
#define VXL_DECLARED_H

#define VXL_VECTORS(type, name)                               \
    typedef type name##2 __attribute__((ext_vector_type(2))); \
    typedef type name##3 __attribute__((ext_vector_type(3))); \
    typedef type name##4 __attribute__((ext_vector_type(4))); \
    typedef type name##8 __attribute__((ext_vector_type(8))); \
    typedef type name##16 __attribute__((ext_vector_type(16)));

typedef unsigned char uchar;
typedef unsigned short ushort;
typedef unsigned int uint;
typedef unsigned long ulong;
VXL_VECTORS(char, char)
VXL_VECTORS(uchar, uchar)
VXL_VECTORS(short, short)
VXL_VECTORS(ushort, ushort)
VXL_VECTORS(int, int)
VXL_VECTORS(uint, uint)
VXL_VECTORS(long, long)
VXL_VECTORS(ulong, ulong)
VXL_VECTORS(float, float)

#define true 1
#define false 0
#define INFINITY (__builtin_inff())
#define FLT_MIN 0x1.0p-126f

#define as_ushort(x) __builtin_astype((x), ushort)
#define as_ushort16(x) __builtin_astype((x), ushort16)
#define as_int(x) __builtin_astype((x), int)
#define as_int4(x) __builtin_astype((x), int4)
#define as_int8(x) __builtin_astype((x), int8)
#define as_int16(x) __builtin_astype((x), int16)
#define as_uint(x) __builtin_astype((x), uint)
#define as_uint2(x) __builtin_astype((x), uint2)
#define as_uint4(x) __builtin_astype((x), uint4)
#define as_uint8(x) __builtin_astype((x), uint8)
#define as_uint16(x) __builtin_astype((x), uint16)
#define as_ulong(x) __builtin_astype((x), ulong)
#define as_ulong2(x) __builtin_astype((x), ulong2)
#define as_ulong4(x) __builtin_astype((x), ulong4)
#define as_float(x) __builtin_astype((x), float)
#define as_float4(x) __builtin_astype((x), float4)
#define as_float8(x) __builtin_astype((x), float8)
#define as_float16(x) __builtin_astype((x), float16)

#define VXL_FUNCTION __attribute__((overloadable, const))
#define VXL_READING __attribute__((overloadable, pure))
#define VXL_WRITING __attribute__((overloadable))

size_t VXL_FUNCTION get_global_id(uint);
size_t VXL_FUNCTION get_global_size(uint);

// These macros write declare(type, n) for scalars, whose n is empty, and for vectors.
#define VXL_VECTOR_SIZES(declare, type) \
    declare(type, 2) declare(type, 3) declare(type, 4) declare(type, 8) declare(type, 16)
#define VXL_SIZES(declare, type) declare(type, ) VXL_VECTOR_SIZES(declare, type)
#define VXL_INTEGERS(sizes, declare)                                                      \
    sizes(declare, short) sizes(declare, ushort) sizes(declare, int) sizes(declare, uint) \
        sizes(declare, long) sizes(declare, ulong)

#define VXL_OF_FLOATS(type, n)                             \
    type##n VXL_FUNCTION ceil(type##n);                    \
    type##n VXL_FUNCTION copysign(type##n, type##n);       \
    type##n VXL_FUNCTION fabs(type##n);                    \
    type##n VXL_FUNCTION floor(type##n);                   \
    type##n VXL_FUNCTION fma(type##n, type##n, type##n);   \
    type##n VXL_FUNCTION fmax(type##n, type##n);           \
    type##n VXL_FUNCTION fmin(type##n, type##n);           \
    type##n VXL_FUNCTION rint(type##n);                    \
    type##n VXL_FUNCTION select(type##n, type##n, int##n); \
    type##n VXL_FUNCTION sqrt(type##n);
VXL_SIZES(VXL_OF_FLOATS, float)

#define VXL_OF_FLOAT_VECTORS(type, n)         \
    type##n VXL_FUNCTION fmax(type##n, type); \
    type##n VXL_FUNCTION fmin(type##n, type);
VXL_VECTOR_SIZES(VXL_OF_FLOAT_VECTORS, float)

#define VXL_OF_NUMBERS(type, n)                            \
    type##n VXL_FUNCTION clamp(type##n, type##n, type##n); \
    type##n VXL_FUNCTION max(type##n, type##n);            \
    type##n VXL_FUNCTION min(type##n, type##n);
VXL_SIZES(VXL_OF_NUMBERS, float)
VXL_INTEGERS(VXL_SIZES, VXL_OF_NUMBERS)

#define VXL_OF_VECTORS(type, n)                      \
    type##n VXL_FUNCTION clamp(type##n, type, type); \
    type##n VXL_FUNCTION max(type##n, type);         \
    type##n VXL_FUNCTION min(type##n, type);
VXL_VECTOR_SIZES(VXL_OF_VECTORS, float)
VXL_INTEGERS(VXL_VECTOR_SIZES, VXL_OF_VECTORS)

#define VXL_OF_INTEGERS(type, n)                   \
    type##n VXL_FUNCTION clz(type##n);             \
    type##n VXL_FUNCTION mul_hi(type##n, type##n); \
    type##n VXL_FUNCTION popcount(type##n);
VXL_INTEGERS(VXL_SIZES, VXL_OF_INTEGERS)

#define VXL_OF_MASKS(type, n)                               \
    int VXL_FUNCTION all(type##n);                          \
    int VXL_FUNCTION any(type##n);                          \
    u##type##n VXL_FUNCTION abs(type##n);                   \
    type##n VXL_FUNCTION select(type##n, type##n, type##n); \
    u##type##n VXL_FUNCTION select(u##type##n, u##type##n, type##n);
VXL_SIZES(VXL_OF_MASKS, short)
VXL_SIZES(VXL_OF_MASKS, int)
VXL_SIZES(VXL_OF_MASKS, long)

#define VXL_CONVERT(type, n)                           \
    char##n VXL_FUNCTION convert_char##n(type##n);     \
    short##n VXL_FUNCTION convert_short##n(type##n);   \
    int##n VXL_FUNCTION convert_int##n(type##n);       \
    int##n VXL_FUNCTION convert_int##n##_rte(type##n); \
    uint##n VXL_FUNCTION convert_uint##n(type##n);     \
    long##n VXL_FUNCTION convert_long##n(type##n);     \
    float##n VXL_FUNCTION convert_float##n(type##n);   \
    float##n VXL_FUNCTION convert_float##n##_rte(type##n);
VXL_SIZES(VXL_CONVERT, float)
VXL_INTEGERS(VXL_SIZES, VXL_CONVERT)

#define VXL_LOAD(type, n)                                       \
    type##n VXL_READING vload##n(size_t, const constant type*); \
    type##n VXL_READING vload##n(size_t, const global type*);   \
    type##n VXL_READING vload##n(size_t, const local type*);    \
    type##n VXL_READING vload##n(size_t, const private type*);  \
    void VXL_WRITING vstore##n(type##n, size_t, global type*);  \
    void VXL_WRITING vstore##n(type##n, size_t, local type*);   \
    void VXL_WRITING vstore##n(type##n, size_t, private type*);
VXL_VECTOR_SIZES(VXL_LOAD, float)
VXL_INTEGERS(VXL_VECTOR_SIZES, VXL_LOAD)

#define VXL_ATOMICS(type)                                     \
    type VXL_WRITING atomic_add(volatile global type*, type); \
    type VXL_WRITING atomic_inc(volatile global type*);       \
    type VXL_WRITING atomic_min(volatile global type*, type); \
    type VXL_WRITING atomic_or(volatile global type*, type);
VXL_ATOMICS(int)
VXL_ATOMICS(uint)

#endif
