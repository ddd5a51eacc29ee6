// How a result was computed: the last part of every result's JSON.
#pragma once

#include <string>

#include <fmt/format.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/json.hpp"

namespace equipoise {

/// "1.20 s, 4.71 s CPU on 4 threads (AVX2)".
template <class Result>
std::string computed_text(const Result& r) {
  return fmt::format("{:.2f} s, {:.2f} s CPU on {} thread{} ({})", r.seconds, r.cpu_seconds, r.threads,
                     plural(r.threads), r.cpu_target);
}

/// Time, threads and instruction set; the study; the version.
template <class Result>
void add_computed(Json& json, const Result& r) {
  put(json, "seconds", r.seconds);
  if constexpr (requires { r.cpu_seconds; }) put(json, "cpu_seconds", r.cpu_seconds);
  put(json, "threads", r.threads, "cpu_target", r.cpu_target, "study_name", r.study.name, "study", r.study, "version",
      version_string);
}

}  // namespace equipoise
