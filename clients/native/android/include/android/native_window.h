#pragma once

// Debian's android-platform-frameworks-native-headers lacks this header, which its native_activity.h includes. The
// viewer passes windows on and asks EGL for their size.

#include <stdint.h>

struct ANativeWindow;
typedef struct ANativeWindow ANativeWindow;

typedef struct ARect {
  int32_t left, top, right, bottom;
} ARect;
