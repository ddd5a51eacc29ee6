// SciPy, through scipy_rival.py in processes of its own; the time its interpreter takes to start is not counted.
#include <cstdint>
#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include "../child.hpp"
#include "equipoise/core/base/error.hpp"
#include "rival.hpp"

namespace equipoise::bench {

namespace {

class Scipy : public Rival {
 public:
  Scipy(const std::string& method, const std::string& python) : method_(method), python_(python) {
    name = "SciPy " + method;
    settings = "solve_ivp, one process a thread, right-hand side through ctypes from compiled code";
  }

  Cost run(const Problem& problem, std::vector<double>& states, int threads) override {
    const std::string path = temporary_path(".states");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(states.data()), static_cast<std::streamsize>(8 * states.size()));
    const model::Parameters& p = problem.parameters;
    const model::Segment& s = problem.segment;
    const nlohmann::json request{{"method", method_},
                                 {"relative", relative_tolerance},
                                 {"absolute", absolute_tolerance},
                                 {"problem",
                                  {p.eccentricity, p.damping[0], p.stiffness[0], p.mass[0], p.mass[1], p.drag[0],
                                   p.drag[1], s.begin, s.psi, s.speed, s.acceleration}},
                                 {"begin", s.begin},
                                 {"end", problem.end},
                                 {"count", states.size() / 8},
                                 {"processes", threads},
                                 {"library", EQUIPOISE_BENCH_RHS_LIBRARY},
                                 {"states", path}};
    const ChildResult child =
        run_child({python_, EQUIPOISE_BENCH_SOURCE_DIR "/rivals/scipy_rival.py"}, request.dump() + "\n");
    std::ifstream(path, std::ios::binary)
        .read(reinterpret_cast<char*>(states.data()), static_cast<std::streamsize>(8 * states.size()));
    std::remove(path.c_str());
    if (!child.ran) throw RunError(name + ": scipy_rival.py failed");
    const auto reply = nlohmann::json::parse(child.output);
    return {reply["wall"].get<double>(), reply["cpu"].get<double>(), reply["evaluations"].get<std::uint64_t>()};
  }

 private:
  std::string method_, python_;
};

}  // namespace

RivalPointer scipy(const std::string& method, const std::string& python) {
  return std::make_unique<Scipy>(method, python);
}

// The first python3 in PATH may be another than the system's, which the distribution's SciPy belongs to.
std::string python_with_scipy(std::string& version) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const ChildResult child =
        run_child({python, "-c", "import scipy.integrate, numpy; print(scipy.__version__, end='')"}, "", true);
    if (!child.ran) continue;
    version = child.output;
    return python;
  }
  return "";
}

}  // namespace equipoise::bench
