// Ipopt as an independent judge of minima, from values and gradients alone.
#pragma once

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <cmath>
#include <functional>

#include "core/types.h"
#include "support/catch.h"

namespace holomorph {

/// A function without constraints. Where its value is infinite, Ipopt takes shorter steps.
class IpoptProblem final : public Ipopt::TNLP {
 public:
  std::function<double(const VectorXd&)> value;
  std::function<VectorXd(const VectorXd&)> gradient;
  VectorXd x;  ///< the start, and then the minimum

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Ipopt::Index>(x.size());
    m = jacobian = hessian = 0;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Ipopt::Index n, double* lowest, double* highest, Ipopt::Index, double*,
                       double*) override {
    std::fill(lowest, lowest + n, -1e19);
    std::fill(highest, highest + n, 1e19);
    return true;
  }
  bool get_starting_point(Ipopt::Index, bool, double* start, bool, double*, double*, Ipopt::Index,
                          bool, double*) override {
    std::copy(x.begin(), x.end(), start);
    return true;
  }
  bool eval_f(Ipopt::Index n, const double* at, bool, double& result) override {
    result = value(Eigen::Map<const VectorXd>(at, n));
    return std::isfinite(result);
  }
  bool eval_grad_f(Ipopt::Index n, const double* at, bool, double* result) override {
    const VectorXd here = Eigen::Map<const VectorXd>(at, n);
    if (!std::isfinite(value(here))) return false;
    Eigen::Map<VectorXd>(result, n) = gradient(here);
    return true;
  }
  bool eval_g(Ipopt::Index, const double*, bool, Ipopt::Index, double*) override { return true; }
  bool eval_jac_g(Ipopt::Index, const double*, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index*,
                  Ipopt::Index*, double*) override {
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index n, const double* at, const double*,
                         const double*, Ipopt::Index, const double*, const double*, double,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    x = Eigen::Map<const VectorXd>(at, n);
  }
};

/// The minimum that Ipopt finds from a start. Fails the test if it finds none.
inline VectorXd minimum_by_ipopt(std::function<double(const VectorXd&)> value,
                                 std::function<VectorXd(const VectorXd&)> gradient,
                                 VectorXd start) {
  const Ipopt::SmartPtr<IpoptProblem> problem = new IpoptProblem;
  problem->value = std::move(value);
  problem->gradient = std::move(gradient);
  problem->x = std::move(start);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> solver = IpoptApplicationFactory();
  solver->Options()->SetIntegerValue("print_level", 0);
  solver->Options()->SetStringValue("sb", "yes");
  solver->Options()->SetStringValue("hessian_approximation", "limited-memory");
  solver->Options()->SetNumericValue("tol", 1e-9);
  solver->Options()->SetIntegerValue("max_iter", 3000);
  REQUIRE(solver->Initialize() == Ipopt::Solve_Succeeded);
  const auto status = solver->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(problem)));
  CHECK((status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level));
  return problem->x;
}

}  // namespace holomorph
