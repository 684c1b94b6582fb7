// SPDX-License-Identifier: Apache-2.0
// Emitters: voxels with emissive surfaces, which light paths look for in global light.
#ifndef VXL_SHARED_EMITTERS_H
#define VXL_SHARED_EMITTERS_H

// Values of the build constant VXL_EMITTERS: how paths find emissive surfaces.
#define VXL_EMITTERS_NONE 0  // paths run into them
#define VXL_EMITTERS_BOTH 1  // also by rays to them; each way is weighted by its probability
#define VXL_EMITTERS_RAYS 2  // those that rays to emitters can find are found by these rays alone

// The surfaces of an emitter lie in the box of its voxel. Rays to it pass the sides of the box that
// face their start.
typedef struct EmitterRecord {
    float corner[3];  // the box's minimum corner, in voxels of the world or an instance's model
    unsigned int instance;  // VXL_NO_INSTANCE: the world
    unsigned int voxel;     // the voxel's number in the pyramid
    unsigned int sides;  // bits 0..5: surfaces may be met through the sides -x, +x, -y, +y, -z, +z
    float probability;   // probability that a ray is sent to this emitter
    float own_share;     // alias table (Walker 1974): share of its slot; `alias` has the rest
    unsigned int alias;
    unsigned int unused;  // 0
} EmitterRecord;
#define VXL_EMITTER_INSTANCE 3  // this and the next ones are words that lanes gather
#define VXL_EMITTER_VOXEL 4
#define VXL_EMITTER_SIDES 5
#define VXL_EMITTER_PROBABILITY 6
#define VXL_EMITTER_SHARE 7
#define VXL_EMITTER_ALIAS 8
#define VXL_EMITTER_WORDS 10

// The map from world voxels w to those of an instance, image + object_from_world * (w - center),
// and its inverse. Frame 0 belongs to the world, frame 1 + i to instance i.
typedef struct EmitterFrame {
    float object_from_world[9];  // by rows
    float world_from_object[9];
    float center[3], image[3];
    float volume;  // of a voxel, cubic metres
    float width;   // at least the length of a voxel's diagonal, in the world's voxels
    float unused[6];
} EmitterFrame;
#define VXL_FRAME_BACK 9
#define VXL_FRAME_CENTER 18
#define VXL_FRAME_IMAGE 21
#define VXL_FRAME_VOLUME 24
#define VXL_FRAME_WIDTH 25
#define VXL_FRAME_WORDS 32

typedef char EmitterRecordHas10Words[sizeof(EmitterRecord) == VXL_EMITTER_WORDS * 4 ? 1 : -1];
typedef char EmitterFrameHas32Words[sizeof(EmitterFrame) == VXL_FRAME_WORDS * 4 ? 1 : -1];

// Emitters are found by their voxel in a hash table of `slots` numbers, a power of two. Each is in
// the first free slot at or after that of its hash.
#define VXL_NO_EMITTER 0xFFFFFFFFu
#define VXL_EMITTER_IS_SKY 0xFFFFFFFEu  // as the emitter of rays to a sky that is a map

static inline unsigned int emitter_hash(unsigned int voxel, unsigned int instance) {
    unsigned int v = voxel * 0x9E3779B1u + instance * 0x85EBCA77u;
    v = (v ^ (v >> 15)) * 0x2C1B3C6Du;
    return v ^ (v >> 13);
}

#endif
