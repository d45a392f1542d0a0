// Sends what a user wants of a dynamic_reconfigure server while a slider is being dragged.
#include "cloth_tearing/rviz/tuning_sender.h"

#include <dynamic_reconfigure/config_tools.h>

#include <QPointer>
#include <algorithm>
#include <chrono>
#include <utility>

namespace cloth_tearing
{

using dynamic_reconfigure::ConfigTools;
using dynamic_reconfigure::Reconfigure;

namespace
{

constexpr std::chrono::milliseconds INTERVAL{ 100 };

}  // namespace

TuningSender::TuningSender(ServiceCaller& caller) : caller_(caller)
{
  pause_.setSingleShot(true);
  connect(&pause_, &QTimer::timeout, this, &TuningSender::send);
}

void TuningSender::setServer(const std::string& name)
{
  server_ = name;
  wanted_.clear();
  calling_ = false;
}

void TuningSender::want(const Values& values)
{
  for (const auto& [name, value] : values)
  {
    wanted_[name] = value;
  }
  send();
}

void TuningSender::send()
{
  if (wanted_.empty() || calling_ || pause_.isActive())
  {
    return;
  }
  Reconfigure::Request request;
  const Values sent = std::exchange(wanted_, {});
  for (const auto& [name, value] : sent)
  {
    ConfigTools::appendParameter(request.config, name, value);
  }
  calling_ = true;
  pause_.start(INTERVAL);
  caller_.call<Reconfigure>(server_ + "/set_parameters", request,
                            [self = QPointer<TuningSender>(this), sent](const auto& answer)
                            {
                              if (self)
                              {
                                self->onAnswer(sent, answer);
                              }
                            });
}

void TuningSender::onAnswer(const Values& sent,
                            const ServiceCaller::Answer<Reconfigure::Response>& answer)
{
  calling_ = false;
  if (!answer.done())
  {
    Q_EMIT failed(QString::fromStdString(answer.problem));
  }
  else if (wanted_.empty())
  {
    const dynamic_reconfigure::Config& values = answer.response.config;
    const bool refused = std::any_of(sent.begin(), sent.end(),
                                     [&values](const auto& entry)
                                     {
                                       double value = 0.0;
                                       ConfigTools::getParameter(values, entry.first, value);
                                       return value != entry.second;
                                     });
    Q_EMIT settled(values, refused);
  }
  send();
}

}  // namespace cloth_tearing
