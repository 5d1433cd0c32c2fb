import {
  BufferGeometry,
  FloatType,
  GLSL3,
  NoBlending,
  OrthographicCamera,
  Points,
  RGBAFormat,
  Scene,
  ShaderMaterial,
  WebGLRenderTarget,
  type WebGLRenderer,
} from 'three';
import { deformDeclarations } from '@client/gpu/deform_shader.ts';
import type { FaceView } from '@client/three/face_view.ts';

/**
 * Reads back the vertices that the shader computes for the current pose: draws each vertex as a point into the pixel of
 * its index, with position or normal as the colour. For tests and diagnosis, not for the frame loop.
 */
export function readDeformed(
  renderer: WebGLRenderer,
  face: FaceView,
): { positions: Float32Array; normals: Float32Array } {
  return { positions: readOne(renderer, face, 'p'), normals: readOne(renderer, face, 'n') };
}

function readOne(renderer: WebGLRenderer, face: FaceView, what: 'p' | 'n'): Float32Array {
  const count = face.mesh.vertexCount;
  const width = 512;
  const height = Math.ceil(count / width);
  const target = new WebGLRenderTarget(width, height, { format: RGBAFormat, type: FloatType, depthBuffer: false });
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    uniforms: { ...face.uniforms },
    vertexShader: /* glsl */ `
      ${deformDeclarations}
      out vec3 probe;
      void main() {
        vec3 p = position;
        vec3 n = normal;
        faceDeform(p, n);
        probe = ${what};
        vec2 pixel = vec2(float(gl_VertexID % ${width}), float(gl_VertexID / ${width})) + 0.5;
        gl_Position = vec4(pixel / vec2(${width}.0, ${height}.0) * 2.0 - 1.0, 0.0, 1.0);
        gl_PointSize = 1.0;
      }`,
    fragmentShader: /* glsl */ `
      in vec3 probe;
      out vec4 color;
      void main() { color = vec4(probe, 1.0); }`,
    blending: NoBlending,
    depthTest: false,
    depthWrite: false,
  });
  const geometry = new BufferGeometry();
  for (const name of ['position', 'normal', 'faceRow'])
    geometry.setAttribute(name, face.object.geometry.getAttribute(name));
  const points = new Points(geometry, material);
  points.frustumCulled = false;
  const scene = new Scene();
  scene.add(points);
  const before = renderer.getRenderTarget();
  renderer.setRenderTarget(target);
  renderer.render(scene, new OrthographicCamera());
  const pixels = new Float32Array(width * height * 4);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  renderer.setRenderTarget(before);
  material.dispose();
  target.dispose();
  const out = new Float32Array(count * 3);
  for (let v = 0; v < count; v += 1) out.set(pixels.subarray(v * 4, v * 4 + 3), v * 3);
  return out;
}
