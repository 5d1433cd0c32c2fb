/** What the tests use of the package, which brings no types of its own. */
declare module 'draco3d' {
  const draco3d: { createDecoderModule(options: object): Promise<unknown> };
  export default draco3d;
}
