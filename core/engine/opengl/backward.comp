// SPDX-License-Identifier: MIT
// The adjoint: one segment an invocation, some of the leaves that a node has in one patch. Nobody else writes
// its sum, so the order of additions is always the same. With CORRECTION green of what is lit is the fourth.
layout(std430, binding = 0) readonly buffer Slices { uvec2 slice[]; };  // first leaf / 32, first place
layout(std430, binding = 1) readonly buffer Leaves { uvec2 leaf[]; };
#ifdef CORRECTION
layout(std430, binding = 2) readonly buffer Back { uvec4 back[]; };
#else
layout(std430, binding = 2) readonly buffer Back { uvec2 back[]; };
#endif
layout(std430, binding = 3) writeonly buffer SegmentSums { vec4 segmentSum[]; };

layout(location = 0) uniform uint firstSlice;
layout(location = 1) uniform uint slices;
layout(location = 2) uniform uint leavesBefore;

void main() {
  uint index = invocation() / 32u;
  uint lane = gl_LocalInvocationID.x % 32u;
  if (index >= slices) return;
  uvec2 here = slice[firstSlice + index];
  uint end = slice[firstSlice + index + 1u].x - leavesBefore;
  uint segment = 32u * (firstSlice + index) + lane;
#ifdef CORRECTION
  vec4 sum = vec4(0.0);
  for (uint k = here.x - leavesBefore; k < end; ++k) {
    uvec2 one = leaf[32u * k + lane];
    uvec4 both = back[here.y + placeOf(one)];
    sum += vec4(codesOf(one), codesOf(one).y) * vec4(unpackFloats(both.xy), uintBitsToFloat(both.z));
  }
  segmentSum[segment] = sum;
#else
  vec3 sum = vec3(0.0);
  for (uint k = here.x - leavesBefore; k < end; ++k) {
    uvec2 one = leaf[32u * k + lane];
    sum += codesOf(one) * unpackFloats(back[here.y + placeOf(one)]);
  }
  segmentSum[segment] = vec4(sum, 0.0);
#endif
}
