// Stands in for team.cpp where there is no MPI library: a job of one process.
#include <cstdlib>
#include <string>

#include "commands.hpp"
#include "team.hpp"

namespace equipoise::app {

class Post {};

std::string mpi_text() { return "not built in"; }
bool has_mpi() { return false; }

Team::Team() = default;
Team::~Team() = default;
bool Team::have_same(const std::string&) { return true; }
bool Team::agree(bool good) { return good; }
void Team::lead(SurveyRun&, const StopFlag*) {}
int Team::follow(const Survey&, int, const StopFlag*) { return done; }
void Team::dismiss() {}
void Team::abort(int) { std::abort(); }

}  // namespace equipoise::app
