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

/// Puts `number`, in the value's own unit, at its key in a study's tree.
void put_value(StudyValue& root, const UncertainValue& value, double number);

/// Throws an InputError about the distribution: at its end `number` the study is refused for the reason `refusal`.
[[noreturn]] void fail_at_end(const StudyFile& file, const UncertainValue& value, double number,
                              const InputError& refusal);

}  // namespace equipoise::study
