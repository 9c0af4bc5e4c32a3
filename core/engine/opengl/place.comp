// SPDX-License-Identifier: MIT
// Content into the camera's view, and what is wanted there.
layout(std430, binding = 0) readonly buffer Content { uint content[]; };
layout(std430, binding = 1) readonly buffer Footprints { uint footprint[]; };  // 5 words a camera pixel
layout(std430, binding = 2) readonly buffer Weights { uint weightPair[]; };
layout(std430, binding = 3) readonly buffer Camera { vec4 camera[]; };
layout(std430, binding = 4) writeonly buffer Wanted { vec4 wanted[]; };  // what is asked for; and the weight
layout(std430, binding = 5) writeonly buffer Unmixed { vec4 unmixed[]; };  // and the sensitivity
layout(std430, binding = 6) writeonly buffer Placed { vec4 placed[]; };
// Behind light of codes there are the gains of white, in octaves: BrightnessField.
layout(std430, binding = 7) readonly buffer LinearOfSrgb { float linearOfSrgb[]; };

layout(location = 0) uniform uint pixels;  // of those that `camera` knows, from
layout(location = 1) uniform uint format;  // as ContentFrame::Format
layout(location = 2) uniform uint bytesPerLine;
layout(location = 3) uniform float white;
layout(location = 4) uniform float lift;
layout(location = 5) uniform float unreachableWeight;
layout(location = 6) uniform mat3 mixing;
// Shares of the channels over white, if errors count as they are seen, and what that scale is offset by.
layout(location = 7) uniform vec3 luminance;
layout(location = 8) uniform float sensitivityOffset;
layout(location = 9) uniform bool isHeld;
layout(location = 10) uniform float sharedLoss;  // compensation::sharedLoss()
layout(location = 11) uniform uint firstPixel;

const uint rgb8 = 0u, rgba8 = 1u, bgra8 = 2u;

float encodedAt(uint place) {
  return linearOfSrgb[(content[place >> 2] >> (8u * (place & 3u))) & 255u];
}

vec3 contentAt(uint x, uint y) {
  uint line = y * bytesPerLine;
  if (format == rgb8) {
    uint place = line + 3u * x;
    return vec3(encodedAt(place), encodedAt(place + 1u), encodedAt(place + 2u));
  }
  if (format == rgba8 || format == bgra8) {
    uint word = content[(line >> 2) + x];
    vec3 light = vec3(linearOfSrgb[word & 255u], linearOfSrgb[(word >> 8) & 255u],
                      linearOfSrgb[(word >> 16) & 255u]);
    return format == rgba8 ? light : light.bgr;
  }
  uint place = (line >> 2) + 3u * x;
  return clampLight(uintBitsToFloat(uvec3(content[place], content[place + 1u], content[place + 2u])));
}

float gainAt(vec2 place) {
  const vec2 cells = vec2(16.0, 12.0);
  vec2 at = clamp(place * cells - 0.5, vec2(0.0), cells - 1.0);
  uvec2 first = min(uvec2(at), uvec2(14u, 10u));
  vec2 share = at - vec2(first);
  uint upper = 256u + 16u * first.y + first.x, lower = upper + 16u;
  return exp2(mix(mix(linearOfSrgb[upper], linearOfSrgb[upper + 1u], share.x),
                  mix(linearOfSrgb[lower], linearOfSrgb[lower + 1u], share.x), share.y));
}

void main() {
  if (invocation() >= pixels) return;
  uint i = firstPixel + invocation();
  uint left = footprint[5u * i], top = footprint[5u * i + 1u], size = footprint[5u * i + 2u];
  uint width = size & 0xffffu, height = size >> 16;
  if (width == 0u) return;

  uint weight = footprint[5u * i + 3u];
  vec3 mean = vec3(0.0);
  for (uint y = top; y < top + height; ++y) {
    for (uint x = left; x < left + width; ++x, ++weight) {
      uint code = (weightPair[weight >> 1] >> (16u * (weight & 1u))) & 0xffffu;
      mean += float(code) * contentAt(x, y);
    }
  }
  mean *= uintBitsToFloat(footprint[5u * i + 4u]);

  uint c = cameraStride * invocation();
  vec4 black = camera[c + cameraBlack];
  vec4 known = camera[c + cameraFlood];
  vec3 flood = known.xyz;
  vec4 last = camera[c + cameraUnmix + 2u];  // of the unmixing; the place in the content
  vec3 value = white * camera[c + cameraLit].w * gainAt(last.yz) * (lift + (1.0 - lift) * (mixing * mean));
  bool reachable = all(greaterThanEqual(value, black.xyz)) && all(lessThanEqual(value, black.xyz + flood));
  vec3 rest = value - black.xyz;
  placed[i] = vec4(mean, 0.0);
  vec3 most = max(flood, vec3(0.0)), lit = max(rest, vec3(0.0));
  vec3 kept = mix(vec3(1.0), most / max(lit, vec3(1e-30)), greaterThan(lit, most));
  vec3 held = min((1.0 - sharedLoss * (1.0 - min(min(kept.r, kept.g), kept.b))) * lit, most);
  float sensitivity = 1.0;
  if (isHeld) sensitivity = (1.0 + sensitivityOffset) / (min(dot(luminance, held + black.xyz), 1.0) + sensitivityOffset);
  float share = weightOf(black.w, known.w) * (reachable ? 1.0 : unreachableWeight);
  wanted[i] = vec4(isHeld ? held : rest, sensitivity * share);
  mat3 unmix = rowsOf(camera[c + cameraUnmix], camera[c + cameraUnmix + 1u], last.x);
  unmixed[i] = vec4(unmix * held, sensitivity);
}
