// Distributions taken out of a study's tree before its numbers are read.
#pragma once

#include <vector>

#include "equipoise/study/table_reader.hpp"
#include "equipoise/study/uncertain.hpp"

namespace equipoise::study {

/// Puts medians in the place of all distributions in rotor, balancer, speed and release; what was written is kept for
/// messages. Throws InputError for a table that is no distribution, and one whose numbers make none.
std::vector<UncertainValue> take_uncertain(Document& document);

/// Puts `number` of the value's own unit where its key stands in a study's tree.
void put_value(StudyValue& root, const UncertainValue& value, double number);

/// Throws an InputError about the distribution: at the end `number` the study is refused for what `refusal` says.
[[noreturn]] void fail_at_end(const Document& document, const UncertainValue& value, double number,
                              const InputError& refusal);

}  // namespace equipoise::study
