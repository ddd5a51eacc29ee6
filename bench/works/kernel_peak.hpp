// The most floating-point operations a second that the instruction set in use allows.
#pragma once

namespace equipoise::bench {

/// Multiply-adds on registers alone for about `seconds`, on the calling thread: operations a second of its processor
/// time, two each.
double multiply_add_peak(double seconds);

}  // namespace equipoise::bench
