/** Small helpers for WebGL 2. */

export class GlError extends Error {}

export function makeProgram(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const program = gl.createProgram();
  for (const [type, text] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp samplerCube;\nprecision highp sampler2DShadow;\n${text}`);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader);
  }
  gl.linkProgram(program);
  // Only asked after linking: asking each shader would wait for it.
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(program)?.map((shader) => gl.getShaderInfoLog(shader)) ?? [];
    throw new GlError([gl.getProgramInfoLog(program), ...logs].filter(Boolean).join('\n'));
  }
  return program;
}

/** The locations of a program's uniforms, by name; an array's is that of its first element. */
export function uniformsOf(gl: WebGL2RenderingContext, program: WebGLProgram): Record<string, WebGLUniformLocation> {
  const found: Record<string, WebGLUniformLocation> = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) as number | null;
  for (let i = 0; i < (count ?? 0); i += 1) {
    const name = gl.getActiveUniform(program, i)!.name;
    found[name.replace('[0]', '')] = gl.getUniformLocation(program, name)!;
  }
  return found;
}

/** 0xrrggbb in sRGB -> linear components */
export function linear(color: number): [number, number, number] {
  const one = (byte: number): number => {
    const c = byte / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  };
  return [one((color >> 16) & 255), one((color >> 8) & 255), one(color & 255)];
}

export const scaled = (v: readonly number[], by: number): number[] => v.map((x) => x * by);
