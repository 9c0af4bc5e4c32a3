// SPDX-License-Identifier: MIT
// One level of a projector's mean pyramid from the next finer one. A pixel counts once however its block is
// cut off by the border.
layout(std430, binding = 0) buffer NodeLight { uvec2 nodeLight[]; };

layout(location = 0) uniform uvec2 pixels;  // of the projector
layout(location = 1) uniform uint side;     // of a block of this level
layout(location = 2) uniform uvec2 grid;    // of this level
layout(location = 3) uniform uint first;    // node of this level
layout(location = 4) uniform uint finerWidth;
layout(location = 5) uniform uint finerFirst;

void main() {
  uint i = invocation();
  if (i >= grid.x * grid.y) return;
  uvec2 place = uvec2(i % grid.x, i / grid.x);
  uvec2 begin = place * side;
  uvec2 end = min(begin + side, pixels);
  uvec2 middle = min(begin + side / 2u, pixels);

  vec3 sum = vec3(0.0);
  for (uint child = 0u; child < 4u; ++child) {
    uvec2 second = uvec2(child & 1u, child >> 1);
    // Of a child: all that the border leaves of it.
    uvec2 extent = (middle - begin) * (1u - second) + (end - middle) * second;
    if (extent.x == 0u || extent.y == 0u) continue;
    uvec2 at = 2u * place + second;
    sum += float(extent.x * extent.y) * unpackLight(nodeLight[finerFirst + at.y * finerWidth + at.x]);
  }
  uvec2 extent = end - begin;
  nodeLight[first + i] = packLight(sum / float(extent.x * extent.y));
}
