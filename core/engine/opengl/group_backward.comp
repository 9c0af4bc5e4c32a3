// SPDX-License-Identifier: MIT
// What goes back through a group's leaves: the sum of what its camera pixels send, in their order.
layout(std430, binding = 0) readonly buffer Groups { uint group[]; };
layout(std430, binding = 1) readonly buffer GroupBack { uint groupBack[]; };  // where camera pixels put it
#ifdef CORRECTION
layout(std430, binding = 2) buffer Back { uvec4 back[]; };
#else
layout(std430, binding = 2) buffer Back { uvec2 back[]; };
#endif

layout(location = 0) uniform uint groups;

void main() {
  uint slot = invocation();
  if (slot >= groups) return;
  uint g = groupStride * slot;
  uint to = group[g + groupPlace];
  if (to == nothing) return;
  float scale = uintBitsToFloat(group[g + groupScale]);
  vec3 sum = vec3(0.0);
#ifdef CORRECTION
  float lit = 0.0;
#endif
  for (uint row = group[g + groupRows]; row < group[g + groupRows + 1u]; ++row) {
#ifdef CORRECTION
    uvec4 both = back[groupBack[row]];
    sum += unpackFloats(both.xy);
    lit += uintBitsToFloat(both.z);
#else
    sum += unpackFloats(back[groupBack[row]]);
#endif
  }
#ifdef CORRECTION
  back[to] = uvec4(packFloats(scale * sum), floatBitsToUint(scale * lit), 0u);
#else
  back[to] = packFloats(scale * sum);
#endif
}
