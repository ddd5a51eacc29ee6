// Distributions taken out of a study's tree before its numbers are read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "equipoise/study/table_reader.hpp"
#include "equipoise/study/uncertain.hpp"

namespace equipoise::study {

inline constexpr std::string_view distribution_forms =
    "{ uniform = [low, high] }, { normal = [mean, standard deviation] }, { loguniform = [low, high] } or "
    "{ values = [..] }, each entry equally likely";
/// Whether numbers in the table with this dotted name may be distributions.
bool takes_distributions(const std::string& dotted);

/// Puts medians in the place of all distributions in rotor, balancer, speed and release; what was written is kept for
/// messages, and tables that name none are left to the reader. Throws InputError for numbers that make no distribution.
std::vector<UncertainValue> take_uncertain(Document& document);

/// Puts `number` of the value's own unit where its key stands in a study's tree.
void put_value(StudyValue& root, const UncertainValue& value, double number);

/// Throws an InputError about the distribution: at the end `number` the study is refused for what `refusal` says.
[[noreturn]] void fail_at_end(const Document& document, const UncertainValue& value, double number,
                              const InputError& refusal);

}  // namespace equipoise::study
