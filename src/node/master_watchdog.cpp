// Makes the node known again to a master that has forgotten it.
#include "cloth_tearing/node/master_watchdog.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/service_manager.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <exception>

namespace cloth_tearing
{

namespace
{

using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds PATIENCE(1);  // with each answer

const std::string& ownUri()
{
  return ros::XMLRPCManager::instance()->getServerURI();
}

bool contains(XmlRpcValue list, const std::string& text)
{
  bool found = false;
  for (int i = 0; i < list.size(); ++i)
  {
    found = found || static_cast<std::string>(list[i]) == text;
  }
  return found;
}

/// @param entries of a master's state: names of topics or services, each with those who serve it
std::set<std::string> namesOfOwn(XmlRpcValue entries)
{
  std::set<std::string> names;
  for (int i = 0; i < entries.size(); ++i)
  {
    if (contains(entries[i][1], ros::this_node::getName()))
    {
      names.insert(static_cast<std::string>(entries[i][0]));
    }
  }
  return names;
}

/// Where this process serves its services, as roscpp tells it.
std::string servicesUri()
{
  return "rosrpc://" + ros::network::getHost() + ":" +
         std::to_string(ros::ConnectionManager::instance()->getTCPPort());
}

/// Another process registered under the name of this one.
class NameTaken : public std::exception
{
};

void refuseTakenName(XmlRpcPeer& master)
{
  std::optional<XmlRpcValue> uri = master.call("lookupNode", { ros::this_node::getName() });
  if (uri && static_cast<std::string>(*uri) != ownUri())
  {
    throw NameTaken();
  }
}

/// What it has to answer.
XmlRpcValue needed(XmlRpcPeer& peer, const std::string& method,
                   const std::initializer_list<XmlRpcValue>& rest)
{
  const std::optional<XmlRpcValue> answer = peer.call(method, rest);
  if (!answer)
  {
    throw NoAnswer(method + " was refused");
  }
  return *answer;
}

/// The master ends whoever had the name before: looked at each time, lest that be a newer node.
XmlRpcValue registerAt(XmlRpcPeer& master, const std::string& method,
                       const std::initializer_list<XmlRpcValue>& what)
{
  refuseTakenName(master);
  return needed(master, method, what);
}

}  // namespace

bool MasterWatchdog::Registrations::empty() const
{
  return publications.empty() && subscriptions.empty() && services.empty();
}

MasterWatchdog::MasterWatchdog(const std::string& name_space, std::chrono::duration<double> period)
    : name_space_(name_space), period_(period)
{
}

MasterWatchdog::~MasterWatchdog()
{
  stop();
}

void MasterWatchdog::start()
{
  look();
  thread_ = std::thread([this] { run(); });
}

void MasterWatchdog::stop()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
  }
  if (thread_.joinable())
  {
    thread_.join();
  }
}

void MasterWatchdog::run()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, period_, [this] { return stopping_.load(); }))
  {
    lock.unlock();
    look();
    lock.lock();
  }
}

void MasterWatchdog::look()
{
  try
  {
    XmlRpcPeer master(ros::master::getURI(), PATIENCE, stopping_);
    lookAt(master);
  }
  catch (const NameTaken&)
  {
    ROS_WARN_STREAM("Another node has taken the name " << ros::this_node::getName()
                                                       << ": this one ends");
    ros::requestShutdown();
  }
  catch (const NoAnswer& error)
  {
    tellIfGone(error.what());
  }
  catch (const XmlRpc::XmlRpcException& error)
  {
    tellIfGone(error.getMessage());
  }
}

void MasterWatchdog::lookAt(XmlRpcPeer& master)
{
  const Registrations known = knownTo(master);
  tellIfBack();
  refuseTakenName(master);
  if (known.empty())
  {
    restoreParameters(master);
  }
  const int missing = registerMissing(master, known);
  if (missing > 0)
  {
    ROS_WARN_STREAM("The master did not know " << missing << " topics and services of "
                                               << ros::this_node::getName()
                                               << ": registered again");
  }
  rememberParameters(master);
}

MasterWatchdog::Registrations MasterWatchdog::knownTo(XmlRpcPeer& master)
{
  XmlRpcValue state = needed(master, "getSystemState", {});
  return { namesOfOwn(state[0]), namesOfOwn(state[1]), namesOfOwn(state[2]) };
}

// -- registrations --------------------------------------------------------------------------------

/// @return how many there were
int MasterWatchdog::registerMissing(XmlRpcPeer& master, const Registrations& known)
{
  return registerTopics(master, known) + registerServices(master, known.services);
}

/// This process tells its topics to whoever asks, itself too: only so are their types known.
int MasterWatchdog::registerTopics(XmlRpcPeer& master, const Registrations& known)
{
  int registered = 0;
  XmlRpcPeer self(ownUri(), PATIENCE, stopping_);
  XmlRpcValue published = needed(self, "getPublications", {});
  for (int i = 0; i < published.size(); ++i)
  {
    if (known.publications.count(published[i][0]) == 0)
    {
      registerAt(master, "registerPublisher", { published[i][0], published[i][1], ownUri() });
      ++registered;
    }
  }
  XmlRpcValue subscribed = needed(self, "getSubscriptions", {});
  for (int i = 0; i < subscribed.size(); ++i)
  {
    if (known.subscriptions.count(subscribed[i][0]) == 0)
    {
      connect(self, subscribed[i][0],
              registerAt(master, "registerSubscriber",
                         { subscribed[i][0], subscribed[i][1], ownUri() }));
      ++registered;
    }
  }
  return registered;
}

/// Connects the topic to publishers that it is not connected to. Those that it is connected to and
/// that the master does not know (yet) have to be named with them, or they would be left.
void MasterWatchdog::connect(XmlRpcPeer& self, const std::string& topic,
                             const XmlRpcValue& publishers)
{
  XmlRpcValue all = publishers;
  XmlRpcValue connections = needed(self, "getBusInfo", {});
  for (int i = 0; i < connections.size(); ++i)
  {
    XmlRpcValue& connection = connections[i];
    const bool incoming = static_cast<std::string>(connection[2]) == "i";
    if (incoming && static_cast<std::string>(connection[4]) == topic &&
        !contains(all, connection[1]))
    {
      all[all.size()] = connection[1];
    }
  }
  needed(self, "publisherUpdate", { topic, all });
}

/// roscpp lists its services nowhere: they are those that the master knew before, as far as they
/// are still there.
int MasterWatchdog::registerServices(XmlRpcPeer& master, const Names& known)
{
  int registered = 0;
  services_.insert(known.begin(), known.end());
  for (auto service = services_.begin(); service != services_.end();)
  {
    const bool served =
        ros::ServiceManager::instance()->lookupServicePublication(*service) != nullptr;
    if (served && known.count(*service) == 0)
    {
      registerAt(master, "registerService", { *service, servicesUri(), ownUri() });
      ++registered;
    }
    service = served ? std::next(service) : services_.erase(service);
  }
  return registered;
}

// -- parameters -----------------------------------------------------------------------------------

void MasterWatchdog::rememberParameters(XmlRpcPeer& master)
{
  parameters_ = master.call("getParam", { name_space_ });
}

void MasterWatchdog::restoreParameters(XmlRpcPeer& master)
{
  if (parameters_ && !master.call("getParam", { name_space_ }))
  {
    needed(master, "setParam", { name_space_, *parameters_ });
    ROS_WARN_STREAM("The master had lost the parameters of " << name_space_ << ": set again");
  }
}

// -- words ----------------------------------------------------------------------------------------

void MasterWatchdog::tellIfGone(const std::string& reason)
{
  if (!gone_ && !stopping_ && ros::ok())
  {
    gone_ = true;
    ROS_WARN_STREAM("The master at " << ros::master::getURI() << " is gone (" << reason
                                     << "): " << ros::this_node::getName()
                                     << " goes on, but cannot be found until it is back");
  }
}

void MasterWatchdog::tellIfBack()
{
  if (gone_)
  {
    gone_ = false;
    ROS_WARN_STREAM("The master at " << ros::master::getURI() << " is back");
  }
}

}  // namespace cloth_tearing
