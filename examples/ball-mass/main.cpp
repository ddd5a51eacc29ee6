// How heavy should the balls be? Shares of starts that end balanced, for several masses of the balls of one machine.
//
//     ball_mass machine.toml 0.02 0.03 0.05
#include <cstdio>
#include <string>

#include <equipoise/equipoise.hpp>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: ball_mass STUDY MASS...\n");
    return 2;
  }
  try {
    std::printf("mass     balanced  95 %% interval\n");
    for (int i = 2; i < argc; ++i) {
      const std::string mass = argv[i];
      const equipoise::Study study = equipoise::read_study(argv[1], {"balancer.mass=" + mass});
      const equipoise::BasinResult answer = equipoise::basin(study);
      const equipoise::Share& balanced = answer.attractors.front().share;  // the first outcome is balance
      std::printf("%-8s %6.2f %%  %.2f to %.2f %%\n", mass.c_str(), 100 * balanced.share, 100 * balanced.low,
                  100 * balanced.high);
    }
  } catch (const equipoise::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());  // names file, key, value and allowed range
    return 2;
  } catch (const equipoise::RunError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
