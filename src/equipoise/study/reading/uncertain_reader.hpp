// Takes distributions out of a study's tree before its numbers are read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "equipoise/study/contents/uncertain.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Whether numbers in the table with this dotted name may be distributions.
bool takes_distributions(const std::string& dotted);

/// Replaces all distributions in rotor, balancer, speed and release by their medians. Original values are kept for
/// messages; tables that name no distribution are left to the reader. Throws InputError for numbers that make none.
std::vector<UncertainValue> take_uncertain(StudyFile& file);

}  // namespace equipoise::study
