// SPDX-License-Identifier: MIT
// What all programs share; it stands in front of each of them.
layout(local_size_x = 64) in;

/// The number of this invocation. Long dispatches have two dimensions, because one may be short of them.
uint invocation() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  return group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

/// What is no number becomes 0.
vec3 clampLight(vec3 light) {
  bvec3 number = lessThanEqual(floatBitsToUint(light) & 0x7fffffffu, uvec3(0x7f800000u));
  return clamp(mix(vec3(0.0), light, number), 0.0, 1.0);
}

/// The two 16-bit codes of a word, lower one first.
ivec2 codesOf(uint word) {
  return ivec2(int(word << 16) >> 16, int(word) >> 16);
}

/// A packed leaf: three codes, and where its light comes from.
vec3 codesOf(uvec2 leaf) {
  return vec3(codesOf(leaf.x), codesOf(leaf.y).x);
}
uint placeOf(uvec2 leaf) {
  return leaf.y >> 16;
}

/// Light between 0 and 1 in 8 bytes, 21 bits a channel: where little light comes back, C blows roundings up.
const float largestLight = 2097151.0;
uvec2 packLight(vec3 light) {
  uvec3 bits = uvec3(light * largestLight + 0.5);
  return uvec2(bits.x | (bits.z << 21), bits.y | ((bits.z >> 11) << 21));
}
vec3 unpackLight(uvec2 code) {
  uvec3 bits = uvec3(code.x & 0x1fffffu, code.y & 0x1fffffu, (code.x >> 21) | ((code.y >> 21) << 11));
  return vec3(bits) * (1.0 / largestLight);
}

/// Three floats of 21 bits in 8 bytes: the whole range of a float, which half floats lack, and more digits.
uvec2 packFloats(vec3 value) {
  uvec3 bits = (floatBitsToUint(value) + 0x400u) & 0xfffff800u;
  return uvec2(bits.x | (bits.z >> 21), bits.y | ((bits.z >> 11) & 0x3ffu));
}
vec3 unpackFloats(uvec2 code) {
  uint third = ((code.x & 0x7ffu) << 21) | ((code.y & 0x3ffu) << 11);
  return uintBitsToFloat(uvec3(code.x & 0xfffff800u, code.y & 0xfffff800u, third));
}

/// What a camera pixel is known by, six to a pixel:
/// black, and where it is usable what no mask takes of it, else 0; flood, and the number of its view; lit, and what no
/// mask takes; nine of the unmixing matrix, row by row, its
/// place in the content, and nothing.
const uint cameraBlack = 0u, cameraFlood = 1u, cameraLit = 2u, cameraUnmix = 3u, cameraStride = 6u;

/// C of a projector pixel, from its share (see StepPreconditioner) and the inverse of what comes back of green.
vec3 preconditioner(vec4 known) {
  return mix(known.xyz * known.w, known.w > 0.0 ? -known.xyz : vec3(0.0), lessThan(known.xyz, vec3(0.0)));
}

/// The weight of a camera pixel: that of its view, by what is left of it and how far it is relied on.
const uint mostViews = 64u;
#ifdef WEIGHTS
layout(location = 16) uniform float viewWeight[mostViews];
float weightOf(float share, float view) {
  return share * viewWeight[uint(view)];
}
#endif

const uint nothing = 0xffffffffu;

/// What a row of T and a group of camera pixels are known by.
const uint rowOwn = 1u, rowShared = 10u, rowGroup = 19u, rowBack = 20u, rowStride = 21u;
const uint groupParent = 0u, groupPlace = 1u, groupRows = 2u, groupScale = 4u, groupStride = 5u;

mat3 rowsOf(vec4 a, vec4 b, float last) {
  return transpose(mat3(a.xyz, vec3(a.w, b.xy), vec3(b.zw, last)));
}

/// A value beyond the projector's range by less than this is not visibly cut: half a code of 8 bits.
const float visibleCut = 0.002;
uint visiblyCut(vec3 light) {
  bvec3 cut = greaterThan(abs(light - 0.5), vec3(0.5 + visibleCut));
  return uint(cut.x) + uint(cut.y) + uint(cut.z);
}
