#include <memory>
#include <utility>

#include "clients/runtime/border.h"
#include "clients/runtime/times.h"
#include "core/performance/performance.h"
#include "protocol/cpp/performance_document.h"

struct semblante_performance {
  explicit semblante_performance(semblante::Performance compiled) : it(std::move(compiled)) {}
  semblante::Performance it;
};

using namespace semblante::runtime;

extern "C" {

semblante_result semblante_performance_create(const char* json, size_t size, semblante_performance** performance,
                                              semblante_error* error) {
  if (performance == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "performance", "the pointer for it is null");
  }
  *performance = nullptr;
  if (json == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "json", "is null");
  return guarded(error, [&] {
    const auto script = semblante::read_performance({json, size});
    if (!script) return fail(error, script.error());
    auto compiled = semblante::Performance::compile(*script);
    if (!compiled) return fail(error, compiled.error());
    *performance = std::make_unique<semblante_performance>(*std::move(compiled)).release();
    return SEMBLANTE_OK;
  });
}

void semblante_performance_destroy(semblante_performance* performance) { delete performance; }

const char* semblante_performance_name(const semblante_performance* performance) {
  return performance == nullptr ? nullptr : performance->it.name().c_str();
}

double semblante_performance_duration(const semblante_performance* performance) {
  return performance == nullptr ? 0 : performance->it.duration();
}

semblante_result semblante_performance_frame_at(const semblante_performance* performance, double ms, double idle_ms,
                                                semblante_frame* frame) {
  if (performance == nullptr || frame == nullptr || !is_time(ms) || !is_time(idle_ms) || ms < 0 || idle_ms < 0) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  return guarded(nullptr, [&] {
    *frame = performance->it.frame_at(ms, idle_ms);
    return SEMBLANTE_OK;
  });
}

}  // extern "C"
