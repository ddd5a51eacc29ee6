// A study as Python holds it: its text, what was set on top of it, and what that reads as.
#pragma once

#include "equipoise/study/ball_details.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"

namespace equipoise::python {

struct PyStudy {
  StudySource source;
  Study study;

  explicit PyStudy(StudySource from) : source(std::move(from)), study(source.with()) {}

  BallDetails balls() const { return parse_ball_details(source.toml, source.name, source.overrides); }
  PyStudy with(const std::vector<std::string>& more) const {
    StudySource changed = source;
    changed.overrides.insert(changed.overrides.end(), more.begin(), more.end());
    return PyStudy(std::move(changed));
  }
};

}  // namespace equipoise::python
