import { deformDeclarations } from '../gpu/deform_shader.ts';
import { skinLook } from '../gpu/studio_look.ts';
import { radianceLevels } from './environment.ts';

/**
 * The programs of the face. Material and light are those of three.js's MeshPhysicalMaterial (metal and roughness, GGX,
 * Charlie sheen, prefiltered surroundings, Khronos' neutral tone curve), as far as a face uses them.
 */
const deformed = `#define attribute in\n${deformDeclarations}`;

export const faceVertex = /* glsl */ `${deformed}
in vec3 position;
in vec3 normal;
in vec2 uv;
in vec3 srgb;
uniform mat4 camera;
uniform mat4 shadowCamera;
uniform float shadowOffset;
out vec3 place;
out vec3 facing;
out vec2 mapPlace;
out vec3 tint;
out vec3 shadowPlace;
void main() {
  tint = mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThanEqual(srgb, vec3(0.04045)));
  vec3 p = position;
  vec3 n = normal;
  faceDeform(p, n);
  place = p;
  facing = n;
  mapPlace = uv;
  shadowPlace = (shadowCamera * vec4(p + shadowOffset * n, 1.0)).xyz * 0.5 + 0.5;
  gl_Position = camera * vec4(p, 1.0);
}`;

export const shadowVertex = /* glsl */ `${deformed}
in vec3 position;
in vec3 normal;
uniform mat4 camera;
void main() {
  vec3 p = position;
  vec3 n = normal;
  faceDeform(p, n);
  gl_Position = camera * vec4(p, 1.0);
}`;

export const shadowFragment = 'void main() {}';

const glslFloat = (x: number): string => x.toFixed(6);

export const faceFragment = /* glsl */ `
#define PI 3.14159265
uniform vec3 eye;
uniform vec4 baseColor;
uniform vec4 plainColor;
uniform float mapShare;
uniform float alphaTest;
uniform bool isOpaque;
uniform float roughness;
uniform float metalness;
uniform bool isSkin;
uniform vec3 sheenColor;
uniform sampler2D baseMap;
uniform sampler2D normalMap;
uniform bool hasNormalMap;
uniform samplerCube radiance;
uniform samplerCube irradiance;
uniform float environmentShare;
uniform vec3 skyColor;
uniform vec3 groundColor;
uniform vec3 keyDirection;
uniform vec3 keyColor;
uniform vec3 rimDirection;
uniform vec3 rimColor;
uniform bool hasShadow;
uniform sampler2DShadow shadowMap;
uniform float shadowShare;
uniform float shadowBias;
uniform float shadowSoftness;
in vec3 place;
in vec3 facing;
in vec2 mapPlace;
in vec3 tint;
in vec3 shadowPlace;
out vec4 color;

struct Surface { vec3 diffuse; vec3 f0; float f90; float roughness; };

float sunlit() {
  if (!hasShadow || any(greaterThan(abs(shadowPlace - 0.5), vec3(0.5)))) return 1.0;
  ${/* A disc of taps, turned by a noise of the pixel that hides its pattern. */ ''}
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    float a = turn + 2.39996323 * float(i);
    vec2 off = sqrt((float(i) + 0.5) / 8.0) * shadowSoftness * vec2(cos(a), sin(a));
    sum += texture(shadowMap, vec3(shadowPlace.xy + off, shadowPlace.z - shadowBias));
  }
  return 1.0 - shadowShare * (1.0 - sum / 8.0);
}

vec3 mapped(vec3 n) {
  vec3 q0 = dFdx(place), q1 = dFdy(place);
  vec2 s0 = dFdx(mapPlace), s1 = dFdy(mapPlace);
  vec3 across = cross(q1, n), along = cross(n, q0);
  vec3 t = across * s0.x + along * s1.x;
  vec3 b = across * s0.y + along * s1.y;
  float size = max(dot(t, t), dot(b, b));
  if (size == 0.0) return n;
  vec3 m = texture(normalMap, mapPlace).xyz * 2.0 - 1.0;
  m.y = -m.y;
  return normalize(inversesqrt(size) * (t * m.x + b * m.y) + n * m.z);
}

/** Light of one direction: diffuse and highlight, then sheen over both. */
vec3 direct(vec3 l, vec3 light, vec3 n, vec3 v, Surface s) {
  float nl = clamp(dot(n, l), 0.0, 1.0);
  if (nl <= 0.0) return vec3(0.0);
  vec3 h = normalize(l + v);
  float nv = clamp(dot(n, v), 0.0, 1.0), nh = clamp(dot(n, h), 0.0, 1.0), vh = clamp(dot(v, h), 0.0, 1.0);
  float a2 = pow(s.roughness, 4.0);
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float visible = 0.5 / max(nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl), 1e-6);
  vec3 fresnel = mix(s.f0, vec3(s.f90), exp2((-5.55473 * vh - 6.98316) * vh));
  vec3 sum = s.diffuse / PI + fresnel * visible * a2 / (PI * d * d);
  if (isSkin) {
    float inverse = 1.0 / (${glslFloat(skinLook.sheenRoughness)} * ${glslFloat(skinLook.sheenRoughness)});
    float charlie = (2.0 + inverse) * pow(max(1.0 - nh * nh, 0.0078125), inverse * 0.5) / (2.0 * PI);
    sum += sheenColor * charlie * clamp(1.0 / (4.0 * (nl + nv - nl * nv)), 0.0, 1.0);
  }
  return light * nl * sum;
}

float sheenOfSurroundings(float nv) {
  const float r = ${glslFloat(skinLook.sheenRoughness)};
  float a = -1.9362 + 1.0678 * r + 0.4573 * r * r - 0.8469 / (r + 0.1);
  float b = -0.6014 + 0.5538 * r - 0.4670 * r * r - 0.1255 / (r + 0.1);
  return clamp(exp(a * nv + b), 0.0, 1.0);
}

/** Share of the surroundings that a rough surface mirrors: a factor of f0 and one of f90. */
vec2 mirrored(float r, float nv) {
  vec4 k = r * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(k.x * k.x, exp2(-9.28 * nv)) * k.x + k.y;
  return vec2(-1.04, 1.04) * a + k.zw;
}

vec3 toneMapped(vec3 c) {
  float least = min(c.r, min(c.g, c.b));
  c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  float peak = max(c.r, max(c.g, c.b));
  if (peak < 0.76) return c;
  float newPeak = 1.0 - 0.0576 / (peak - 0.52);
  c *= newPeak / peak;
  return mix(c, vec3(newPeak), 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0));
}

void main() {
  vec4 base = mix(plainColor, baseColor * texture(baseMap, mapPlace), mapShare);
  if (base.a < alphaTest) discard;
  base.rgb *= tint;
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 n = side * normalize(facing);
  vec3 change = max(abs(dFdx(n)), abs(dFdy(n)));
  if (hasNormalMap) n = mapped(n);
  vec3 v = normalize(eye - place);
  float nv = clamp(dot(n, v), 0.0, 1.0);

  Surface s;
  s.roughness = min(max(roughness, 0.045) + max(change.x, max(change.y, change.z)), 1.0);
  s.diffuse = base.rgb * (1.0 - metalness);
  float strength = isSkin ? ${glslFloat(skinLook.specularIntensity)} : 1.0;
  s.f0 = mix(vec3(0.04 * strength), base.rgb, metalness);
  s.f90 = mix(strength, 1.0, metalness);

  vec3 sum = direct(keyDirection, keyColor * sunlit(), n, v, s) + direct(rimDirection, rimColor, n, v, s);

  vec3 around = textureLod(irradiance, n, 0.0).rgb * environmentShare;
  vec3 reflected = normalize(mix(reflect(-v, n), n, pow(s.roughness, 4.0)));
  vec3 ahead = textureLod(radiance, reflected, s.roughness * ${glslFloat(radianceLevels - 1)}).rgb * environmentShare;
  vec3 hemisphere = mix(groundColor, skyColor, 0.5 * n.y + 0.5);
  vec2 share = mirrored(s.roughness, nv);
  vec3 single = s.f0 * share.x + s.f90 * share.y;
  float kept = share.x + share.y;
  vec3 mean = s.f0 + (1.0 - s.f0) * 0.047619;
  vec3 multiple = single * mean / (1.0 - (1.0 - kept) * mean) * (1.0 - kept);
  float scattered = 1.0 - max(max((single + multiple).r, (single + multiple).g), (single + multiple).b);
  vec3 ambient = s.diffuse * (hemisphere / PI + around * scattered) + ahead * single + around * multiple;
  if (isSkin) {
    float sheen = sheenOfSurroundings(nv);
    float tallest = max(sheenColor.r, max(sheenColor.g, sheenColor.b));
    sum *= 1.0 - tallest * sheen;
    ambient = ambient * (1.0 - tallest * sheen) + around * sheenColor * sheen;
  }
  vec3 seen = toneMapped(sum + ambient);
  seen = mix(1.055 * pow(max(seen, 0.0), vec3(1.0 / 2.4)) - 0.055, 12.92 * seen, vec3(lessThanEqual(seen, vec3(0.0031308))));
  float opacity = isOpaque ? 1.0 : base.a;
  color = vec4(seen * opacity, opacity);
}`;
