// The module's one door: a request as JSON in, a reply as JSON out, errors in the program's form.
#include <emscripten.h>

#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "calls.hpp"
#include "equipoise/core/base/version.hpp"

// The worker's listener, if it has set one. What clang-format takes for C++ must be both.
EM_JS(void, equipoise_tell, (const char* what, double done, double total, int preparing), {
  if (Module["onProgress"]) Module["onProgress"](UTF8ToString(what), done, total, !!preparing);
});

namespace equipoise::web {

namespace {

using Call = std::function<Json(const Json&, Bulk&)>;

const std::map<std::string, Call>& calls() {
  const auto plain = [](Json (*call)(const Json&)) { return [call](const Json& args, Bulk&) { return call(args); }; };
  static const std::map<std::string, Call> all{
      {"version",
       [](const Json&, Bulk&) {
         return Json{{"version", version_string}};
       }},
      {"check", plain(check_study)},
      {"presets", plain(presets)},
      {"discover", search_attractors},
      {"ensemble", ensemble},
      {"states", states},
      {"shares", plain(shares)},
      {"compare_shares", plain(compare_shares)},
      {"one_body", one_body},
      {"try_change", try_change},
      {"judge", plain(judge)},
      {"play_open", play_open},
      {"play_advance", play_advance},
      {"play_rows", play_rows},
      {"play_close", plain(play_close)},
  };
  return all;
}

Json problem(const char* kind, const std::string& message) {
  return {{"message", message}, {"key", ""}, {"value", ""}, {"problem", message},
          {"allowed", ""},      {"line", 0}, {"kind", kind}};
}

Json answer(const std::string& request, Bulk& bulk) {
  try {
    const Json asked = Json::parse(request);
    return {{"result", calls().at(asked.at("call").get<std::string>())(asked.at("args"), bulk)}};
  } catch (const InputError& e) {
    return {{"error", problem_json(e)}};
  } catch (const std::exception& e) {
    return {{"error", problem("run", e.what())}};
  }
}

}  // namespace

Json problem_json(const InputError& e) {
  return {{"message", e.what()},
          {"key", e.key()},
          {"value", e.value()},
          {"problem", e.wrong().empty() ? e.problem() : e.wrong()},
          {"allowed", e.allowed()},
          {"line", e.place().line},
          {"kind", "input"}};
}

Study study_of(const Json& toml) { return parse_study(toml.get<std::string>(), study_name); }

void tell(const Progress& p) {
  equipoise_tell(p.what.c_str(), static_cast<double>(p.done), static_cast<double>(p.total), p.preparing);
}

}  // namespace equipoise::web

extern "C" {

// The reply, and the arrays it points to, stay until the next call.
EMSCRIPTEN_KEEPALIVE const char* equipoise_call(const char* request) {
  using namespace equipoise::web;
  static std::optional<Bulk> bulk;
  static std::string reply;
  bulk.emplace();
  reply = answer(request, *bulk).dump(-1, ' ', false, Json::error_handler_t::replace);
  return reply.c_str();
}
}
