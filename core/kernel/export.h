/* Internal: marks the exports of the kernel as a WebAssembly module of its own. */
#ifndef SEMBLANTE_KERNEL_EXPORT_H
#define SEMBLANTE_KERNEL_EXPORT_H

#if defined(__wasm__) && !defined(__wasi__)
#define SEMBLANTE_EXPORT(name) __attribute__((export_name(#name)))
#else
#define SEMBLANTE_EXPORT(name)
#endif

#endif
