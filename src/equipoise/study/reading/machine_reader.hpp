// The tables of the machine itself, of both forms of studies; quantities are read in SI units.
#pragma once

#include <optional>
#include <string>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// [rotor] with its tables, and every [[place]].
void read_rotor(const StudyFile& file, Study& study);
/// [balancer]. A rotor without balls states its race at most.
void read_balancer(const StudyFile& file, Study& study);
/// [speed]: a ramp function or a motor with its load.
void read_speed(const StudyFile& file, Study& study);

/// The mm/s of a balance quality grade, "G 6.3"; empty if the text names none.
std::optional<double> grade_named(const std::string& text);

}  // namespace equipoise::study
