/** npm's draco3d ships no types; only tests use it, through its documented functions. */
declare module 'draco3d' {
  export function createDecoderModule(options: object): Promise<unknown>;
}
