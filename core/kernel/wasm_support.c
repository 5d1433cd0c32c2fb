/* Replaces the C library in the module: memory for the caller, and the two functions that compilers call. */
#include <stddef.h>
#include <stdint.h>

#include "core/kernel/semblante_kernel.h"

/* Defined by the linker: the first byte after data and stack. */
extern unsigned char __heap_base; /* NOLINT(bugprone-reserved-identifier) */

#define PAGE_BYTES 65536U

static uint32_t used = 0; /* bytes after __heap_base */

__attribute__((export_name("semblante_alloc"))) void* semblante_alloc(uint32_t bytes) {
  const uint64_t base = (uint64_t)(uintptr_t)&__heap_base;
  const uint64_t start = (base + used + 15U) & ~(uint64_t)15U;
  const uint64_t end = start + bytes; /* in 64 bits: cannot wrap */
  const uint64_t have = (uint64_t)__builtin_wasm_memory_size(0) * PAGE_BYTES;
  if (end > have) {
    const uint64_t pages = (end - have + PAGE_BYTES - 1) / PAGE_BYTES;
    if (end > UINT32_MAX || __builtin_wasm_memory_grow(0, (unsigned long)pages) == (unsigned long)-1) {
      return NULL;
    }
  }
  used = (uint32_t)(end - base);
  return &__heap_base + (start - base);
}

__attribute__((export_name("semblante_free_all"))) void semblante_free_all(void) { used = 0; }

void* memset(void* to, int value, size_t bytes) {
  for (size_t i = 0; i < bytes; ++i) {
    ((unsigned char*)to)[i] = (unsigned char)value;
  }
  return to;
}

void* memcpy(void* to, const void* from, size_t bytes) {
  for (size_t i = 0; i < bytes; ++i) {
    ((unsigned char*)to)[i] = ((const unsigned char*)from)[i];
  }
  return to;
}
