// How a result was computed: what all JSON of results ends with.
#pragma once

#include "equipoise/base/version.hpp"
#include "equipoise/report/text.hpp"

namespace equipoise {

/// Time, threads and instruction set; the study; the version.
template <class Json, class Result>
void add_computed(Json& json, const Result& r) {
  json["seconds"] = r.seconds;
  if constexpr (requires { r.cpu_seconds; }) json["cpu_seconds"] = r.cpu_seconds;
  json["threads"] = r.threads;
  json["cpu_target"] = r.cpu_target;
  json["study_name"] = r.study.name;
  json["study"] = study_json(r.study);
  json["version"] = version_string;
}

}  // namespace equipoise
