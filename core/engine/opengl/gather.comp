// SPDX-License-Identifier: MIT
// The light of all nodes that a patch touches, one behind the other, so that leaves reach it by 16 bits.
layout(std430, binding = 0) readonly buffer Nodes { uint node[]; };
layout(std430, binding = 1) readonly buffer NodeLight { uvec2 nodeLight[]; };
layout(std430, binding = 2) writeonly buffer ColumnLight { uvec2 columnLight[]; };

layout(location = 0) uniform uint columns;

void main() {
  uint column = invocation();
  if (column < columns) columnLight[column] = nodeLight[node[column]];
}
