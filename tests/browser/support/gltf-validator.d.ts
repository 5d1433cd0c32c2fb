/** Types of the Khronos glTF validator, whose npm package has none. */
declare module 'gltf-validator' {
  export interface ValidationReport {
    issues: {
      numErrors: number;
      numWarnings: number;
      /** severity: 0 error, 1 warning, 2 information, 3 hint */
      messages: { code: string; message: string; severity: number; pointer?: string }[];
    };
    info: {
      animationCount: number;
      hasSkins: boolean;
      hasTextures: boolean;
      maxInfluences: number;
      totalVertexCount: number;
      totalTriangleCount: number;
    };
  }
  export function validateBytes(data: Uint8Array, options?: object): Promise<ValidationReport>;
}
