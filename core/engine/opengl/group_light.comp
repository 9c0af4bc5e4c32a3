// SPDX-License-Identifier: MIT
// What a group sees with all groups around it, behind the columns' light.
layout(std430, binding = 0) readonly buffer Groups { uint group[]; };
layout(std430, binding = 1) readonly buffer OwnLight { vec4 ownLight[]; };
layout(std430, binding = 2) writeonly buffer ColumnLight { uvec2 columnLight[]; };

layout(location = 0) uniform uint groups;
layout(location = 1) uniform uint columns;

void main() {
  uint slot = invocation();
  if (slot >= groups) return;
  vec3 sum = vec3(0.0);
  for (uint at = slot; at != nothing; at = group[groupStride * at + groupParent]) sum += ownLight[at].xyz;
  columnLight[columns + slot] = packFloats(sum);
}
