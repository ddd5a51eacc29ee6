// Publications of Rodrigues, Champneys, Friswell and Wilson.
#pragma once

#include "equipoise/extras/publications/publication.hpp"

namespace equipoise {

namespace rodrigues {

using Settings = std::vector<std::string>;

/// A row of their long rotor, studies/publications/long-rotor.toml.
PublicationRow of_long_rotor(const char* place, const char* quantity, KnownBy known_by, Estimate published,
                             Settings settings, Estimate (*computed)(const Study&, const RunOptions&),
                             const char* reason = "");
/// Settings of its static unbalance alone, 0.01, and more of them.
Settings static_alone(Settings more);

}  // namespace rodrigues

Publication rodrigues_2008();
Publication rodrigues_enoc();
Publication rodrigues_virm();
Publication rodrigues_2010();
Publication rodrigues_2011();

}  // namespace equipoise
