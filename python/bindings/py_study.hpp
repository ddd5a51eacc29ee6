// A study as Python holds it: its text, what was set on top of it, and what that reads as.
#pragma once

#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::python {

struct PyStudy {
  StudySource source;
  Study study;

  explicit PyStudy(StudySource from) : source(std::move(from)), study(source.with()) {}

  PyStudy with(const std::vector<std::string>& more) const {
    StudySource changed = source;
    changed.overrides.insert(changed.overrides.end(), more.begin(), more.end());
    return PyStudy(std::move(changed));
  }
};

}  // namespace equipoise::python
