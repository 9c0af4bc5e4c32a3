// SPDX-License-Identifier: MIT
// What a group of camera pixels sees through its own leaves: one group an invocation.
layout(std430, binding = 0) readonly buffer Slices { uvec2 slice[]; };  // first leaf / 32, first column
layout(std430, binding = 1) readonly buffer Leaves { uvec2 leaf[]; };
layout(std430, binding = 2) readonly buffer ColumnLight { uvec2 columnLight[]; };
layout(std430, binding = 3) readonly buffer Groups { uint group[]; };
layout(std430, binding = 4) writeonly buffer OwnLight { vec4 ownLight[]; };

layout(location = 0) uniform uint firstSlice;
layout(location = 1) uniform uint slices;
layout(location = 2) uniform uint leavesBefore;  // / 32: those of the slices before what is bound

void main() {
  uint index = invocation() / 32u;
  uint lane = gl_LocalInvocationID.x % 32u;
  if (index >= slices) return;
  uvec2 here = slice[firstSlice + index];
  uint end = slice[firstSlice + index + 1u].x - leavesBefore;
  vec3 seen = vec3(0.0);
  for (uint k = here.x - leavesBefore; k < end; ++k) {
    uvec2 one = leaf[32u * k + lane];
    seen += codesOf(one) * unpackLight(columnLight[here.y + placeOf(one)]);
  }
  uint slot = 32u * (firstSlice + index) + lane;
  ownLight[slot] = vec4(uintBitsToFloat(group[groupStride * slot + groupScale]) * seen, 0.0);
}
