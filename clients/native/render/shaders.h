#pragma once

namespace semblante::render::shaders {

/// Renders depth from the key light, for its shadow map.
inline constexpr const char* shadow_vertex = R"(#version 300 es
layout(location = 0) in vec3 position;
uniform mat4 to_light;
void main() { gl_Position = to_light * vec4(position, 1.0); }
)";
inline constexpr const char* shadow_fragment = R"(#version 300 es
precision mediump float;
void main() {}
)";

inline constexpr const char* face_vertex = R"(#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 srgb;
uniform mat4 to_clip;
uniform mat4 to_light;
uniform mat4 to_front_light;
uniform float shadow_offset;
out vec3 at;
out vec3 across;
out vec2 texture_at;
out vec3 tint;
out vec4 in_light;
out vec4 in_front_light;
void main() {
  tint = mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThanEqual(srgb, vec3(0.04045)));
  at = position;
  across = normal;
  texture_at = uv;
  // Offset from the surface, so that the flat triangles of a coarse head do not shadow each other.
  vec4 above = vec4(position + normal * shadow_offset, 1.0);
  in_light = to_light * above;
  in_front_light = to_front_light * above;
  gl_Position = to_clip * vec4(position, 1.0);
}
)";

/// Key, fill and rim light over a sky-and-ground ambient. Writes linear light; the target encodes it as sRGB.
inline constexpr const char* face_fragment = R"(#version 300 es
precision highp float;
precision highp sampler2DShadow;
in vec3 at;
in vec3 across;
in vec2 texture_at;
in vec3 tint;
in vec4 in_light;
in vec4 in_front_light;
uniform vec3 camera;
uniform vec3 key_direction;
uniform vec3 fill_direction;
uniform vec3 rim_direction;
uniform vec4 base_color;
uniform float roughness;
uniform float specular;
uniform int is_skin;
uniform int has_texture;
uniform float alpha_cutoff;
uniform sampler2D base_texture;
uniform sampler2DShadow key_shadow;
uniform sampler2DShadow front_shadow;
out vec4 color;

// `near`: how much nearer to the light, in depth of the map, something may be without a shadow.
float lit(sampler2DShadow map, vec4 place, float slope, float near) {
  vec3 p = place.xyz / place.w * 0.5 + 0.5;
  if (any(lessThan(p.xy, vec2(0.0))) || any(greaterThan(p.xy, vec2(1.0)))) return 1.0;
  float texel = 1.0 / float(textureSize(map, 0).x);
  float bias = 0.001 + 0.005 * slope + near;
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      sum += texture(map, vec3(p.xy + vec2(x, y) * 2.2 * texel, p.z - bias));
  return sum / 9.0;
}

vec3 shade(vec3 n, vec3 v, vec3 l, vec3 light, vec3 albedo, float shadow) {
  // Subsurface scattering of skin: light extends beyond the edge of the shadow, red the farthest.
  vec3 wrap = is_skin == 1 ? vec3(0.30, 0.16, 0.11) : vec3(0.04);
  vec3 diffuse = max((vec3(dot(n, l)) + wrap) / (1.0 + wrap), 0.0);
  vec3 soft_shadow = is_skin == 1 ? mix(vec3(0.10, 0.03, 0.02), vec3(1.0), shadow) : vec3(shadow);
  vec3 h = normalize(l + v);
  float a = roughness * roughness;
  float nh = max(dot(n, h), 0.0);
  float d = a * a / max(3.14159 * pow(nh * nh * (a * a - 1.0) + 1.0, 2.0), 1e-4);
  float fresnel = specular + (1.0 - specular) * pow(1.0 - max(dot(h, v), 0.0), 5.0);
  float glint = min(d * fresnel * 0.25 / max(mix(dot(n, v), 1.0, 0.35), 0.05), 6.0);
  return light * (albedo * diffuse * soft_shadow + glint * max(dot(n, l), 0.0) * shadow);
}

void main() {
  vec4 base = vec4(tint, 1.0) * base_color;
  if (has_texture == 1) base *= texture(base_texture, texture_at);
  if (base.a < alpha_cutoff) discard;
  vec3 n = normalize(across);
  vec3 v = normalize(camera - at);
  if (!gl_FrontFacing) n = -n;
  vec3 albedo = base.rgb;
  float key = lit(key_shadow, in_light, 1.0 - max(dot(n, key_direction), 0.0), 0.0);
  // Little light enters a mouth: surfaces in the shadow of the front light also get less ambient light. A shallow
  // fold, such as that of a lid, shuts out little of either.
  float open = lit(front_shadow, in_front_light, 1.0 - max(dot(n, fill_direction), 0.0), 0.012);
  float sky = n.y * 0.5 + 0.5;
  vec3 ambient = mix(vec3(0.20, 0.17, 0.155), vec3(0.36, 0.38, 0.41), sky) * mix(0.42, 1.0, open);
  vec3 sum = albedo * ambient;
  sum += shade(n, v, key_direction, vec3(1.20, 1.15, 1.08), albedo, key);
  sum += shade(n, v, fill_direction, vec3(0.40, 0.43, 0.48), albedo, open);
  float rim = pow(1.0 - max(dot(n, v), 0.0), 3.0) * max(dot(n, rim_direction), 0.0);
  // By the albedo, so that the dark lining of an open mouth stays dark: the light has no shadow map.
  sum += vec3(0.42, 0.46, 0.54) * (0.1 + 1.2 * albedo) * rim * open;
  // Prevents clipped highlights without greying the rest.
  sum = sum / (1.0 + 0.16 * max(max(sum.r, sum.g), sum.b)) * 1.08;
  color = vec4(sum, base.a);
}
)";

/// Puts a head, drawn premultiplied, over the backdrop of a window, and encodes as sRGB. A triangle that covers it all.
inline constexpr const char* present_vertex = R"(#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
)";
inline constexpr const char* present_fragment = R"(#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D head;
uniform vec3 top;
uniform vec3 bottom;
out vec4 color;
void main() {
  vec4 front = texture(head, place);
  vec3 light = clamp(front.rgb + mix(bottom, top, place.y) * (1.0 - front.a), 0.0, 1.0);
  vec3 bright = 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055;
  color = vec4(mix(bright, light * 12.92, lessThanEqual(light, vec3(0.0031308))), 1.0);
}
)";

inline constexpr const char* words_vertex = R"(#version 300 es
layout(location = 0) in vec2 place;
void main() { gl_Position = vec4(place, 0.0, 1.0); }
)";
inline constexpr const char* words_fragment = R"(#version 300 es
precision mediump float;
uniform vec4 tint;
out vec4 color;
void main() { color = tint; }
)";

}  // namespace semblante::render::shaders
