/* The heap of the WebAssembly module, in place of the C library's, which is ten times as large. Small blocks that were
 * freed wait in a list of their size, so that a document of a million parts costs no search. Larger ones are in one
 * list by rising address, neighbours joined. A face, a stream and a player take memory when they are made, not per
 * frame. */
#include <errno.h>
#include <stddef.h>
#include <stdint.h>

#define PAGE_BYTES 65536U
#define UNIT ((size_t)16)
#define SMALL_UNITS 32 /* the largest small block */

/* In front of each block. The memory that is given out follows it, and is aligned like it. */
typedef struct block {
  size_t units; /* of 16 bytes, with this one */
  struct block* next;
  size_t unused[2];
} block;

_Static_assert(sizeof(block) == UNIT, "a block is one unit");

/* Defined by the linker: the first byte after data and stack. */
extern unsigned char __heap_base; /* NOLINT(bugprone-reserved-identifier) */

static block empty = {0, &empty, {0, 0}};
/* Where the last search ended: the list is a ring. */
static block* last = &empty;
static int has_first_pages = 0;
/* Freed small blocks by their units. */
static block* small[SMALL_UNITS + 1];

void free(void* memory) {
  if (memory == NULL) return;
  block* const freed = (block*)memory - 1;
  if (freed->units <= SMALL_UNITS) {
    freed->next = small[freed->units];
    small[freed->units] = freed;
    return;
  }
  block* before = last;
  /* The place between two neighbours by address; the ring's end lies where addresses fall. */
  while (!(freed > before && freed < before->next)) {
    if (before >= before->next && (freed > before || freed < before->next)) break;
    before = before->next;
  }
  if (freed + freed->units == before->next) {
    freed->units += before->next->units;
    freed->next = before->next->next;
  } else {
    freed->next = before->next;
  }
  if (before + before->units == freed) {
    before->units += freed->units;
    before->next = freed->next;
  } else {
    before->next = freed;
  }
  last = before;
}

/* More pages as a free block. 0: there are none. */
static int grow(size_t units) {
  const uint64_t end = (uint64_t)__builtin_wasm_memory_size(0) * PAGE_BYTES;
  uint64_t start = end;
  if (!has_first_pages) start = ((uint64_t)(uintptr_t)&__heap_base + UNIT - 1) / UNIT * UNIT;
  const uint64_t wanted = start + (uint64_t)units * UNIT;
  uint64_t have = end;
  if (wanted > end) {
    const uint64_t pages = (wanted - end + PAGE_BYTES - 1) / PAGE_BYTES;
    have += pages * PAGE_BYTES;
    if (have > UINT32_MAX || __builtin_wasm_memory_grow(0, (unsigned long)pages) == (unsigned long)-1) return 0;
  }
  has_first_pages = 1;
  block* const made = (block*)(uintptr_t)start;
  made->units = (size_t)((have - start) / UNIT);
  free(made + 1);
  return 1;
}

/* `alignment`: a power of two, at least 16. */
static void* allocate(size_t alignment, size_t bytes) {
  if (bytes > UINT32_MAX - 2 * UNIT - alignment) return NULL;
  const size_t units = (bytes + UNIT - 1) / UNIT + 1;
  const size_t slack = alignment / UNIT - 1; /* units that alignment may leave free in front */
  if (units <= SMALL_UNITS && slack == 0 && small[units] != NULL) {
    block* const found = small[units];
    small[units] = found->next;
    return found + 1;
  }
  for (block* before = last;;) {
    block* const found = before->next;
    if (found->units >= units) {
      /* Cut from the end, so that the block in front stays in the list. */
      const uintptr_t end = (uintptr_t)(found + found->units);
      const uintptr_t start = (end - (units - 1) * UNIT) / alignment * alignment - UNIT;
      if (start >= (uintptr_t)found) {
        block* const cut = (block*)start;
        const size_t behind = (end - start) / UNIT - units;
        last = before;
        if (cut == found) {
          before->next = found->next;
        } else {
          found->units = (size_t)(cut - found);
        }
        cut->units = units;
        if (behind > 0) {
          block* const rest = cut + units;
          rest->units = behind;
          free(rest + 1);
        }
        return cut + 1;
      }
    }
    if (found == last) {
      if (!grow(units + slack)) return NULL;
      before = last;
    } else {
      before = found;
    }
  }
}

void* malloc(size_t bytes) { return allocate(UNIT, bytes); }

void* aligned_alloc(size_t alignment, size_t bytes) { return allocate(alignment < UNIT ? UNIT : alignment, bytes); }

int posix_memalign(void** memory, size_t alignment, size_t bytes) {
  void* const found = aligned_alloc(alignment, bytes);
  if (found == NULL) return ENOMEM;
  *memory = found;
  return 0;
}

void* calloc(size_t count, size_t bytes) {
  if (bytes != 0 && count > UINT32_MAX / bytes) return NULL;
  void* const memory = malloc(count * bytes);
  if (memory != NULL) __builtin_memset(memory, 0, count * bytes);
  return memory;
}

void* realloc(void* memory, size_t bytes) {
  if (memory == NULL) return malloc(bytes);
  const size_t have = (((block*)memory - 1)->units - 1) * UNIT;
  if (bytes <= have) return memory;
  void* const moved = malloc(bytes);
  if (moved == NULL) return NULL;
  __builtin_memcpy(moved, memory, have);
  free(memory);
  return moved;
}

/* One instruction each. */
void* memcpy(void* restrict to, const void* restrict from, size_t bytes) { return __builtin_memcpy(to, from, bytes); }
void* memmove(void* to, const void* from, size_t bytes) { return __builtin_memmove(to, from, bytes); }
void* memset(void* to, int value, size_t bytes) { return __builtin_memset(to, value, bytes); }
