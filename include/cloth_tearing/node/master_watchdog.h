// Makes the node known again to a master that has forgotten it.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "cloth_tearing/node/xmlrpc_peer.h"

namespace cloth_tearing
{

/// A master that was started again knows nobody, and roscpp registers only once. Asks it every so
/// often what it knows of this process, and registers what is missing: topics that are published
/// and subscribed to, and services. Connections that there are stay. Parameters below the node's
/// name that went with the old master are set again as they were, unless there are new ones: a
/// node that is started anew has to find the same cloth. Those of others, /use_sim_time among
/// them, are for others to set.
///
/// If another process has taken the name, this one is asked to end, as a master asks it.
class MasterWatchdog
{
public:
  /// @param name_space of the node's parameters
  /// @param period from one look to the next [s]
  MasterWatchdog(const std::string& name_space, std::chrono::duration<double> period);

  MasterWatchdog(const MasterWatchdog&) = delete;
  MasterWatchdog& operator=(const MasterWatchdog&) = delete;

  ~MasterWatchdog();

  /// To be called when all is registered: looks at once, then every period on a thread of its own.
  void start();

  /// Looks no more. Ends soon even if the master answers nothing.
  void stop();

private:
  using Names = std::set<std::string>;

  /// What a master knows of this node, or this node of itself.
  struct Registrations
  {
    Names publications;
    Names subscriptions;
    Names services;

    bool empty() const;
  };

  void run();
  void look();
  void lookAt(XmlRpcPeer& master);

  static Registrations knownTo(XmlRpcPeer& master);
  int registerMissing(XmlRpcPeer& master, const Registrations& known);
  int registerTopics(XmlRpcPeer& master, const Registrations& known);
  int registerServices(XmlRpcPeer& master, const Names& known);
  static void connect(XmlRpcPeer& self, const std::string& topic,
                      const XmlRpc::XmlRpcValue& publishers);
  void rememberParameters(XmlRpcPeer& master);
  void restoreParameters(XmlRpcPeer& master);
  void tellIfGone(const std::string& reason);
  void tellIfBack();

  const std::string name_space_;
  const std::chrono::duration<double> period_;
  bool gone_ = false;
  Names services_;  ///< of this node, as far as a master ever knew them
  std::optional<XmlRpc::XmlRpcValue> parameters_;  ///< as the master last had them

  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<bool> stopping_{ false };
  std::thread thread_;
};

}  // namespace cloth_tearing
