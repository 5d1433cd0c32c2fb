import { makeProgram, uniformsOf } from './gl.ts';

/**
 * The room that lights the head, the same as three.js's RoomEnvironment, which the studio uses: a white box with a lamp,
 * six smaller boxes and six area lights. Drawn once per graphics context into two cube maps.
 */
export interface Environment {
  /** level k: radiance blurred for roughness k / (radianceLevels - 1) */
  radiance: WebGLTexture;
  irradiance: WebGLTexture;
}

export const radianceLevels = 6;
const irradianceSize = 8;

const vertex = /* glsl */ `
out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(at, 0.0, 1.0);
}`;

const direction = /* glsl */ `
uniform int side;
in vec2 at;
out vec4 color;
vec3 directionAt(int side, vec2 p) {
  if (side == 0) return vec3(1.0, -p.y, -p.x);
  if (side == 1) return vec3(-1.0, -p.y, p.x);
  if (side == 2) return vec3(p.x, 1.0, p.y);
  if (side == 3) return vec3(p.x, -1.0, -p.y);
  if (side == 4) return vec3(p.x, -p.y, 1.0);
  return vec3(-p.x, -p.y, -1.0);
}`;

/** Centre, half sizes (w of the centre: turn about y; w of the sizes: emitted light). */
const boxes: readonly (readonly [readonly number[], readonly number[]])[] = [
  [[-10.906, 2.009, 1.846, -0.195], [2.328, 7.905, 4.651, 0]],
  [[-5.607, -0.754, -0.758, 0.994], [1.97, 1.534, 3.955, 0]],
  [[6.167, 0.857, 7.803, 0.561], [3.927, 6.285, 3.687, 0]],
  [[-2.017, 0.018, 6.124, 0.333], [2.002, 4.566, 2.064, 0]],
  [[2.291, -0.756, -2.621, -0.286], [1.546, 1.552, 1.496, 0]],
  [[-2.193, -0.369, -5.547, 0.516], [3.875, 3.487, 2.986, 0]],
  [[-16.116, 14.37, 8.208, 0], [0.1, 2.428, 2.739, 50]],
  [[-16.109, 18.021, -8.207, 0], [0.1, 2.425, 2.751, 50]],
  [[14.904, 12.198, -1.832, 0], [0.15, 4.265, 6.331, 17]],
  [[-0.462, 8.89, 14.52, 0], [4.38, 5.441, 0.088, 43]],
  [[3.235, 11.486, -12.541, 0], [2.5, 2.0, 0.1, 20]],
  [[0, 20, 0, 0], [1, 0.1, 1, 100]],
];
const glslVectors = (which: 0 | 1): string =>
  boxes.map((box) => `vec4(${box[which].map((x, i) => (which === 1 && i < 3 ? x / 2 : x).toFixed(4)).join()})`).join();

const room = /* glsl */ `${direction}
uniform float texel;
const vec4 centres[${boxes.length}] = vec4[](${glslVectors(0)});
const vec4 halves[${boxes.length}] = vec4[](${glslVectors(1)});
const vec3 lamp = vec3(0.418, 16.199, 0.3);
vec3 lit(vec3 place, vec3 normal) {
  vec3 to = lamp - place;
  float d = length(to);
  float window = clamp(1.0 - pow(d / 28.0, 4.0), 0.0, 1.0);
  return vec3(900.0 / (d * d) * window * window * max(dot(normal, to) / d, 0.0) / 3.14159265);
}
vec3 turned(vec3 v, float by) {
  return vec3(cos(by) * v.x - sin(by) * v.z, v.y, sin(by) * v.x + cos(by) * v.z);
}
vec3 seen(vec3 ray) {
  vec3 from = vec3(0.0, 3.5, 0.0);
  vec3 inside = from - vec3(-0.757, 13.219, 0.717);
  vec3 wall = (sign(ray) * vec3(15.8565, 14.1525, 14.2955) - inside) / ray;
  float nearest = min(wall.x, min(wall.y, wall.z));
  vec3 normal = -sign(ray) * vec3(equal(wall, vec3(nearest)));
  vec3 light = lit(from + nearest * ray, normal);
  for (int i = 0; i < ${boxes.length}; ++i) {
    vec3 o = turned(from - centres[i].xyz, centres[i].w);
    vec3 d = turned(ray, centres[i].w);
    vec3 middle = -o / d;
    vec3 reach = abs(halves[i].xyz / d);
    vec3 enter = middle - reach;
    vec3 leave = middle + reach;
    float first = max(enter.x, max(enter.y, enter.z));
    if (first < 0.0 || first > min(leave.x, min(leave.y, leave.z)) || first > nearest) continue;
    nearest = first;
    vec3 n = turned(-sign(d) * vec3(equal(enter, vec3(first))), -centres[i].w);
    light = halves[i].w > 0.0 ? vec3(halves[i].w) : lit(from + first * ray, n);
  }
  return light;
}
void main() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i)
    sum += seen(normalize(directionAt(side, at + texel * (vec2(i % 3, i / 3) - 1.0) / 3.0) + 1e-5));
  color = vec4(sum / 9.0, 1.0);
}`;

const blurred = /* glsl */ `${direction}
uniform samplerCube source;
uniform float roughness;
uniform float size;
void main() {
  vec3 n = normalize(directionAt(side, at));
  if (roughness == 0.0) { color = textureLod(source, n, 0.0); return; }
  vec3 t = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
  vec3 b = cross(n, t);
  float a2 = pow(roughness, 4.0);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 96; ++i) {
    float turn = 2.39996323 * float(i);
    float u = (float(i) + 0.5) / 96.0;
    float c2 = (1.0 - u) / (1.0 + (a2 - 1.0) * u);
    float c = sqrt(c2);
    float s = sqrt(1.0 - c2);
    vec3 h = s * (cos(turn) * t + sin(turn) * b) + c * n;
    vec3 l = 2.0 * c * h - n;
    float weight = dot(n, l);
    if (weight <= 0.0) continue;
    float d = c2 * (a2 - 1.0) + 1.0;
    float density = a2 / (3.14159265 * d * d) / 4.0;
    float level = 0.5 * log2(6.0 * size * size / (4.0 * 3.14159265 * 96.0 * density)) + 1.0;
    sum += weight * vec4(textureLod(source, l, max(level, 0.0)).rgb, 1.0);
  }
  color = vec4(sum.rgb / sum.w, 1.0);
}`;

const gathered = /* glsl */ `${direction}
uniform samplerCube source;
uniform float level;
void main() {
  vec3 n = normalize(directionAt(side, at));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 1536; ++i) {
    vec2 p = (vec2(i % 16, (i / 16) % 16) + 0.5) / 8.0 - 1.0;
    vec3 l = directionAt(i / 256, p);
    float distance2 = dot(l, l);
    float solid = 1.0 / (distance2 * sqrt(distance2));
    float cosine = max(dot(n, l) / sqrt(distance2), 0.0);
    sum += vec4(textureLod(source, l, level).rgb * cosine, cosine) * solid;
  }
  color = vec4(sum.rgb / sum.w, 1.0);
}`;

/** Draws the room. `size`: edge of the cube map, a power of two of at least 32. */
export function makeEnvironment(gl: WebGL2RenderingContext, size: number): Environment {
  const canDrawFloats = gl.getExtension('EXT_color_buffer_float') ?? gl.getExtension('EXT_color_buffer_half_float');
  if (!canDrawFloats) return evenEnvironment(gl);
  const raw = cubeMap(gl, size, Math.log2(size) + 1, gl.RGBA16F);
  const radiance = cubeMap(gl, size, radianceLevels, gl.RGBA16F);
  const irradiance = cubeMap(gl, irradianceSize, 1, gl.RGBA16F);
  const target = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.disable(gl.DEPTH_TEST);
  gl.disable(gl.BLEND);

  drawSides(gl, room, raw, size, 0, { texel: 2 / size });
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, raw);
  gl.generateMipmap(gl.TEXTURE_CUBE_MAP);
  for (let level = 0; level < radianceLevels; level += 1) {
    drawSides(gl, blurred, radiance, size >> level, level, { roughness: level / (radianceLevels - 1), size });
  }
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, raw);
  drawSides(gl, gathered, irradiance, irradianceSize, 0, { level: Math.log2(size) - 4 });

  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.deleteFramebuffer(target);
  gl.deleteTexture(raw);
  return { radiance, irradiance };
}

/** Where nothing can be drawn into float textures: light of the room's mean from everywhere. */
function evenEnvironment(gl: WebGL2RenderingContext): Environment {
  const even = cubeMap(gl, 1, 1, gl.RGBA8);
  for (let side = 0; side < 6; side += 1) {
    gl.texSubImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + side, 0, 0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4).fill(230));
  }
  return { radiance: even, irradiance: even };
}

function cubeMap(gl: WebGL2RenderingContext, size: number, levels: number, format: number): WebGLTexture {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, texture);
  gl.texStorage2D(gl.TEXTURE_CUBE_MAP, levels, format, size, size);
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MIN_FILTER, levels > 1 ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
  return texture;
}

/** Draws the six sides of one level; what is bound as the cube map is the source. */
function drawSides(
  gl: WebGL2RenderingContext,
  fragment: string,
  texture: WebGLTexture,
  size: number,
  level: number,
  values: Record<string, number>,
): void {
  const program = makeProgram(gl, vertex, fragment);
  const uniforms = uniformsOf(gl, program);
  gl.useProgram(program);
  for (const [name, value] of Object.entries(values)) gl.uniform1f(uniforms[name] ?? null, value);
  gl.viewport(0, 0, size, size);
  for (let side = 0; side < 6; side += 1) {
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_CUBE_MAP_POSITIVE_X + side, texture, level);
    gl.uniform1i(uniforms['side'] ?? null, side);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
  gl.deleteProgram(program);
}
