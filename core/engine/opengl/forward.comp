// SPDX-License-Identifier: MIT
// One camera pixel an invocation: its residual W (wanted - T p), and what of that goes back to its own leaves and
// to its group, mixings included. With CORRECTION the light wanted is held to what there is, green of W T 1 goes back
// beside it, and the residual is unmixed for the windows, which know of no sensitivity.
layout(std430, binding = 0) readonly buffer Slices { uvec2 slice[]; };  // first leaf / 32, first column
layout(std430, binding = 1) readonly buffer Leaves { uvec2 leaf[]; };
layout(std430, binding = 2) readonly buffer ColumnLight { uvec2 columnLight[]; };
layout(std430, binding = 3) readonly buffer Rows { uint row[]; };
layout(std430, binding = 4) readonly buffer Wanted { vec4 wanted[]; };
#ifdef CORRECTION
layout(std430, binding = 5) writeonly buffer Back { uvec4 back[]; };
layout(std430, binding = 6) readonly buffer Camera { vec4 camera[]; };
layout(std430, binding = 7) buffer Unmixed { vec4 unmixed[]; };  // see place.comp
#else
layout(std430, binding = 5) writeonly buffer Back { uvec2 back[]; };
#endif

layout(location = 0) uniform uint firstSlice;
layout(location = 1) uniform uint slices;
layout(location = 2) uniform uint leavesBefore;  // / 32: those of the slices before what is bound
layout(location = 3) uniform uint columns;       // behind their light there is that of groups
#ifdef CORRECTION
layout(location = 4) uniform uint pixelsBefore;  // those that `camera` knows
#endif

mat3 mixingAt(uint at) {  // its columns are the mixing's rows
  mat3 mixing;
  for (uint i = 0u; i < 3u; ++i, at += 3u) mixing[i] = uintBitsToFloat(uvec3(row[at], row[at + 1u], row[at + 2u]));
  return mixing;
}

void main() {
  uint index = invocation() / 32u;
  uint lane = gl_LocalInvocationID.x % 32u;
  if (index >= slices) return;
  uvec2 here = slice[firstSlice + index];
  uint end = slice[firstSlice + index + 1u].x - leavesBefore;
  uint r = rowStride * (32u * index + lane);
  vec3 own = vec3(0.0);
  for (uint k = here.x - leavesBefore; k < end; ++k) {
    uvec2 one = leaf[32u * k + lane];
    own += codesOf(one) * unpackLight(columnLight[here.y + placeOf(one)]);
  }

  uint pixel = row[r];
  if (pixel == nothing) return;
  uint to = row[r + rowBack];
  vec4 want = wanted[pixel];
  if (want.w == 0.0) {
#ifdef CORRECTION
    back[to] = uvec4(0u);
    back[to + 1u] = uvec4(0u);
    unmixed[pixel] = vec4(0.0);
#else
    back[to] = uvec2(0u);
    back[to + 1u] = uvec2(0u);
#endif
    return;
  }
  mat3 ownMixing = mixingAt(r + rowOwn), sharedMixing = mixingAt(r + rowShared);
  vec3 seen = own * ownMixing;
  uint group = row[r + rowGroup];
  if (group != nothing) seen += unpackFloats(columnLight[columns + group]) * sharedMixing;
#ifdef CORRECTION
  uint c = cameraStride * (pixel - pixelsBefore);
  vec3 held = clamp(want.xyz, vec3(0.0), max(camera[c + cameraFlood].xyz, vec3(0.0)));
  vec3 residual = want.w * (held - seen);
  vec3 lit = want.w * camera[c + cameraLit].xyz;
  back[to] = uvec4(packFloats(ownMixing * residual), floatBitsToUint((ownMixing * lit).y), 0u);
  back[to + 1u] = uvec4(packFloats(sharedMixing * residual), floatBitsToUint((sharedMixing * lit).y), 0u);
  mat3 unmix = rowsOf(camera[c + cameraUnmix], camera[c + cameraUnmix + 1u], camera[c + cameraUnmix + 2u].x);
  unmixed[pixel] = vec4(unmix * residual / unmixed[pixel].w, 0.0);
#else
  vec3 residual = want.w * (want.xyz - seen);
  back[to] = packFloats(ownMixing * residual);
  back[to + 1u] = packFloats(sharedMixing * residual);
#endif
}
