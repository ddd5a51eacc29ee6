// What errors call values that an override gave.
#pragma once

namespace equipoise {

/// Of a study's values that came as "key=value" beside its text: the name of their place in an InputError. Whoever took
/// them from elsewhere (an option, a field of a form) may say from where.
inline constexpr const char* overrides_name = "overridden value";

}  // namespace equipoise
