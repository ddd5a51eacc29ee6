// Without threads, work and callbacks share the only one: every report also asks whether to stop.
#include "equipoise/core/running/reporting.hpp"

namespace equipoise {

void Reporting::heed_stop() {
  if (is_set(asked_.stop) || (asked_.stop_asked && asked_.stop_asked())) stop_ = true;
}

void Reporting::run(const std::function<void()>& work) {
  heed_stop();
  work();
}

void Reporting::call(const std::function<void()>& callback) {
  callback();
  heed_stop();
}

}  // namespace equipoise
