// SPDX-License-Identifier: MIT
// The yardstick of benchmarks: memory as fast as it can be copied.
layout(std430, binding = 0) readonly buffer From { uvec4 from[]; };
layout(std430, binding = 1) writeonly buffer To { uvec4 to[]; };

layout(location = 0) uniform uint count;

void main() {
  uint i = invocation();
  if (i < count) to[i] = from[i];
}
