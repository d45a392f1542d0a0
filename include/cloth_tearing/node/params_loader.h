// Carries parameters from the parameter server into the node and names everything wrong with them.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cloth_tearing/node/node_params.h"
#include "cloth_tearing/node/param_reader.h"

namespace cloth_tearing
{

struct LoadedParams
{
  NodeParams params;
  std::vector<std::string> problems;  ///< one sentence each; empty if `params` can be used
};

/// Reads a tree of parameters over the defaults. Wrong types, values that are not finite or out of
/// range and unknown names are all reported, not only the first; a group's entries are named
/// group/entry.
///
/// @param tree the node's private namespace: a struct, or an invalid value if there is none
LoadedParams loadParams(const XmlRpc::XmlRpcValue& tree);

/// @throws std::invalid_argument naming all `problems` of the parameters in a namespace, if any
void refuseWrongParams(const std::string& name_space, const std::vector<std::string>& problems);

/// The names of all parameters, group/entry, ascending.
std::vector<std::string> parameterNames();

/// The names of material/stiffness_law.
const std::map<std::string, cloth::StiffnessLaw>& stiffnessLaws();

/// What other nodes are told in the same words: the group `markers`, how a rectangle is meshed, and
/// `solver`.
void readMarkers(ParamReader& reader, MarkerStyle& style);
void readPattern(ParamReader& reader, const std::string& name, cloth::RectanglePattern& pattern);
void readSeed(ParamReader& reader, const std::string& name, std::uint64_t& seed);
void readSolver(ParamReader& reader, cloth::SolverKind& solver);

}  // namespace cloth_tearing
