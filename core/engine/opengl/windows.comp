// SPDX-License-Identifier: MIT
// The windows. Two pixels of a tile and their three channels an invocation, so that the invocations of a
// tile read whole runs of weights. The first time p = clamp(M u); with CORRECTION
// p = clamp(p + m M u + a C adjoint), and C itself; with LAST, too, p stays, and M is not read.
layout(std430, binding = 0) readonly buffer Tiles { uvec4 tileAt[]; };  // first row, scale of each channel
layout(std430, binding = 1) readonly buffer Rows { uint row[]; };
layout(std430, binding = 2) readonly buffer Weights { uint codePair[]; };
layout(std430, binding = 3) readonly buffer Unmixed { vec4 unmixed[]; };
layout(std430, binding = 4) buffer Light { vec4 light[]; };  // and the share of a pixel that may be used, 0 where it is not free
layout(std430, binding = 5) writeonly buffer NodeLight { uvec2 nodeLight[]; };
#ifdef CORRECTION
// Of every node what comes back of the residual, and of green of what is lit; then, from `firstStep` on, what C of every
// pixel is made of, see common.glsl.
layout(std430, binding = 6) buffer Sums { vec4 sums[]; };
layout(std430, binding = 7) buffer Counters { uint cutAll; };
shared uint cutHere;
layout(location = 8) uniform float byInverse;
layout(location = 9) uniform float byAdjoint;
layout(location = 10) uniform uint firstStep;
layout(location = 11) uniform float least;
layout(location = 12) uniform float nextToNothing;
#endif

layout(location = 0) uniform uint firstTile;
layout(location = 1) uniform uint tiles;
layout(location = 2) uniform uint tile0;  // the projector's first
layout(location = 3) uniform uint gridWidth;
layout(location = 4) uniform uint side;
layout(location = 5) uniform uvec2 size;
layout(location = 6) uniform uint firstPixel;
layout(location = 7) uniform uint firstWord;  // of the weights that are bound

uint store(uint tile, uint inTile, vec3 value) {
  uint x = (tile - tile0) % gridWidth * side + inTile % side;
  uint y = (tile - tile0) / gridWidth * side + inTile / side;
  if (x >= size.x || y >= size.y) return 0u;
  uint j = firstPixel + y * size.x + x;
  vec4 before = light[j];
#ifdef CORRECTION
  vec4 back = sums[j];
  // What hardly any weighted pixel sees would take steps of any length on rounding errors.
  sums[firstStep + j].w = before.w > 0.0 ? (back.w > least ? 1.0 / back.w : nextToNothing) : 0.0;
#ifdef LAST
  value = before.w > 0.0 ? before.xyz : vec3(0.0);
#else
  value = before.xyz + before.w * (byInverse * value + byAdjoint * preconditioner(sums[firstStep + j]) * back.xyz);
#endif
  uint cut = visiblyCut(value);
  value = min(clampLight(value), vec3(before.w));
#else
  value = before.w * clampLight(value);
  const uint cut = 0u;
#endif
  light[j] = vec4(value, before.w);
  nodeLight[j] = packLight(value);
  return cut;
}

void main() {
  uint pairs = side * side / 2u;
  uint tile = firstTile + invocation() / pairs;
  uint pair = invocation() % pairs;
  uint cut = 0u;
  if (tile < firstTile + tiles) {
    vec3 even = vec3(0.0), odd = vec3(0.0);
    uvec4 here = tileAt[tile];
#ifdef LAST
    uint end = here.x;
#else
    uint end = tileAt[tile + 1u].x;
#endif
    for (uint k = here.x; k < end; ++k) {
      vec3 u = unmixed[row[k]].xyz;
      uint place = 3u * pairs * k + pair - firstWord;
      ivec2 red = codesOf(codePair[place]);
      ivec2 green = codesOf(codePair[place + pairs]);
      ivec2 blue = codesOf(codePair[place + 2u * pairs]);
      even += u * vec3(red.x, green.x, blue.x);
      odd += u * vec3(red.y, green.y, blue.y);
    }
    vec3 ofTile = uintBitsToFloat(here.yzw);
    cut = store(tile, 2u * pair, ofTile * even) + store(tile, 2u * pair + 1u, ofTile * odd);
  }
#ifdef CORRECTION
  if (gl_LocalInvocationID.x == 0u) cutHere = 0u;
  barrier();
  if (cut > 0u) atomicAdd(cutHere, cut);
  barrier();
  if (gl_LocalInvocationID.x == 0u && cutHere > 0u) atomicAdd(cutAll, cutHere);
#endif
}
