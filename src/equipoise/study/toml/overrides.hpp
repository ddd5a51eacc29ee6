// The name that errors give to overridden values.
#pragma once

namespace equipoise {

/// Place in an InputError of a value given as "key=value" next to a study's text. A caller that knows the origin (an
/// option, a field of a form) may replace it.
inline constexpr const char* overrides_name = "overridden value";

}  // namespace equipoise
