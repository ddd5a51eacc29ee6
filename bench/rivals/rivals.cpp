// The list of rivals.
#include "rival.hpp"

namespace equipoise::bench {

Rivals all_rivals() {
  Rivals rivals;
  rivals.present.push_back(odeint_dopri5_lanes());
  rivals.present.push_back(odeint_dopri5());
  rivals.present.push_back(odeint_fehlberg78());
#ifdef EQUIPOISE_BENCH_SUNDIALS
  rivals.present.push_back(arkode_dopri5());
  rivals.present.push_back(cvode_adams());
#else
  rivals.missing.push_back("SUNDIALS (CVODE, ARKODE): not found when this program was configured");
#endif
  std::string version;
  const std::string python = python_with_scipy(version);
  if (!python.empty()) {
    rivals.present.push_back(scipy("DOP853", python));
    rivals.present.push_back(scipy("LSODA", python));
  } else {
    rivals.missing.push_back("SciPy: no python3 here can import it");
  }
  return rivals;
}

}  // namespace equipoise::bench
