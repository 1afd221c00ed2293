// Tests the cone program against an independent solver, Ipopt, and against its own guarantees.
#include "core/solvers/cone_program.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <random>

#include "core/error.h"
#include "support/catch.h"

namespace holomorph::cone_program_test {

namespace {

struct Instance {
  ConeSystem system;
  ConeTarget target;
  VectorXd start;
};

/// A small L_nu-like program: three cones, an L1 fit, random rows.
Instance random_instance(unsigned seed, int p, int q, int m, bool with_fit) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto matrix = [&](int rows, int columns) {
    MatrixXd a(rows, columns);
    for (double& x : a.reshaped()) x = normal(random);
    return a;
  };
  Instance instance;
  ConeSystem& system = instance.system;
  system.height = matrix(p, m);
  system.re = matrix(q, m);
  system.im = matrix(q, m);
  const auto same = [](double x) { return VectorXd::Constant(1, x); };
  system.cones = {{same(0.7), 0, 0}, {same(std::log(5.0)), -1, 0}, {same(1), 0, 0.2}};
  const MatrixXd root = matrix(p + q, p + q);
  system.quadratic = root * root.transpose() / (p + q) + 0.1 * MatrixXd::Identity(p + q, p + q);
  if (with_fit) {
    system.fit = matrix(p, m);
    system.fit_weight = 1.0 / m;
    instance.target.wanted = 2 * matrix(m, 1);
  } else {
    system.fit.resize(p, 0);
    instance.target.wanted.resize(0);
  }
  instance.target.linear = matrix(p + q, 1);
  instance.start = VectorXd::Zero(p + q);  // u = 0, w = 0
  return instance;
}

/// The same program for Ipopt: unknowns x and the bounds t of |fit . a - wanted|.
class Program final : public Ipopt::TNLP {
 public:
  explicit Program(const Instance& instance)
      : s_(instance.system),
        t_(instance.target),
        p_(static_cast<int>(s_.height.rows())),
        n_(static_cast<int>(s_.unknowns())),
        m_(static_cast<int>(s_.samples())),
        k_(static_cast<int>(s_.fit.cols())),
        start_(instance.start) {}

  VectorXd solution;

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = n_ + k_;
    m = cones() + 2 * k_;
    jacobian = m * n;
    hessian = 0;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Ipopt::Index n, double* xl, double* xu, Ipopt::Index m, double* gl,
                       double* gu) override {
    std::fill(xl, xl + n, -1e19);
    std::fill(xu, xu + n, 1e19);
    std::fill(gl, gl + m, 0.0);
    std::fill(gu, gu + m, 1e19);
    return true;
  }
  bool get_starting_point(Ipopt::Index n, bool, double* x, bool, double*, double*, Ipopt::Index,
                          bool, double*) override {
    std::fill(x, x + n, 1.0);
    std::copy(start_.begin(), start_.end(), x);
    return true;
  }
  bool eval_f(Ipopt::Index, const double* x, bool, double& f) override {
    const Eigen::Map<const VectorXd> all(x, n_);
    f = 0.5 * all.dot(s_.quadratic * all) + t_.linear.dot(all);
    for (int i = 0; i < k_; ++i) f += s_.fit_weight * x[n_ + i];
    return true;
  }
  bool eval_grad_f(Ipopt::Index, const double* x, bool, double* gradient) override {
    const Eigen::Map<const VectorXd> all(x, n_);
    Eigen::Map<VectorXd>(gradient, n_) = s_.quadratic * all + t_.linear;
    std::fill(gradient + n_, gradient + n_ + k_, s_.fit_weight);
    return true;
  }
  bool eval_g(Ipopt::Index, const double* x, bool, Ipopt::Index, double* g) override {
    int at = 0;
    for (const Cone& cone : s_.cones)
      for (int i = 0; i < m_; ++i) {
        const auto [u, re, im] = values(x, i);
        g[at++] = cone.height(i, u, std::exp(-u)) - std::sqrt(re * re + im * im + kRound);
      }
    for (int i = 0; i < k_; ++i) {
      const double r = s_.fit.col(i).dot(Eigen::Map<const VectorXd>(x, p_)) - t_.wanted[i];
      g[at++] = x[n_ + i] - r;
      g[at++] = x[n_ + i] + r;
    }
    return true;
  }
  bool eval_jac_g(Ipopt::Index n, const double* x, bool, Ipopt::Index m, Ipopt::Index,
                  Ipopt::Index* rows, Ipopt::Index* columns, double* out) override {
    if (!out) {
      for (int i = 0; i < m * n; ++i) rows[i] = i / n, columns[i] = i % n;
      return true;
    }
    std::fill(out, out + m * n, 0.0);
    int at = 0;
    for (const Cone& cone : s_.cones)
      for (int i = 0; i < m_; ++i, ++at) {
        const auto [u, re, im] = values(x, i);
        const double slope = cone.slope + cone.decay * std::exp(-u),
                     size = std::sqrt(re * re + im * im + kRound);
        for (int j = 0; j < p_; ++j) out[at * n + j] = slope * s_.height(j, i);
        for (int j = p_; j < n_; ++j)
          out[at * n + j] = -(re * s_.re(j - p_, i) + im * s_.im(j - p_, i)) / size;
      }
    for (int i = 0; i < k_; ++i)
      for (const double sign : {-1.0, 1.0}) {
        for (int j = 0; j < p_; ++j) out[at * n + j] = sign * s_.fit(j, i);
        out[at++ * n + n_ + i] = 1;
      }
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index, const double* x, const double*,
                         const double*, Ipopt::Index, const double*, const double*, double,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    solution = Eigen::Map<const VectorXd>(x, n_);
  }

 private:
  static constexpr double kRound = 1e-14;  ///< rounds off the tips of the cones, for derivatives
  struct Values {
    double u, re, im;
  };
  Values values(const double* x, int i) const {
    const Eigen::Map<const VectorXd> a(x, p_), b(x + p_, n_ - p_);
    return {s_.height.col(i).dot(a), s_.re.col(i).dot(b), s_.im.col(i).dot(b)};
  }
  int cones() const { return static_cast<int>(s_.cones.size()) * m_; }

  const ConeSystem& s_;
  const ConeTarget& t_;
  int p_, n_, m_, k_;
  VectorXd start_;
};

double ipopt_energy(const Instance& instance) {
  const Ipopt::SmartPtr<Program> program = new Program(instance);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> solver = IpoptApplicationFactory();
  solver->Options()->SetIntegerValue("print_level", 0);
  solver->Options()->SetStringValue("sb", "yes");
  solver->Options()->SetStringValue("hessian_approximation", "limited-memory");
  solver->Options()->SetNumericValue("tol", 1e-9);
  solver->Options()->SetIntegerValue("max_iter", 400);
  REQUIRE(solver->Initialize() == Ipopt::Solve_Succeeded);
  const auto status = solver->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(program)));
  // Ipopt sometimes stops at the tips of the cones, where derivatives jump.
  if (status != Ipopt::Solve_Succeeded) return std::numeric_limits<double>::quiet_NaN();
  return energy_of(instance.system, instance.target, program->solution);
}

ConeSettings exact() {
  ConeSettings settings;
  settings.gap = 1e-9;
  settings.residual = 1e-7;
  return settings;
}

ConeSolution from(const VectorXd& x) {
  ConeSolution start;
  start.x = x;
  return start;
}

}  // namespace

TEST_CASE("Cone program: its minimum equals Ipopt's") {
  int compared = 0;
  const int count = few_or_many(4, 8);
  for (int seed = 1; seed <= count; ++seed)
    for (const bool with_fit : {false, true}) {
      const Instance instance = random_instance(static_cast<unsigned>(seed), 6, 5, 24, with_fit);
      const ConeSolution solution =
          solved(instance.system, instance.target, exact(), from(instance.start));
      const double other = ipopt_energy(instance);
      INFO("seed " << seed << (with_fit ? ", with a fit" : "") << ": " << solution.energy << " in "
                   << solution.iterations << ", gap " << solution.gap << ", residual "
                   << solution.residual << "; Ipopt " << other);
      CHECK(solution.status == ConeSolution::Status::solved);
      CHECK(is_feasible(instance.system, solution.x));
      if (std::isnan(other)) continue;
      ++compared;
      CHECK(std::abs(solution.energy - other) <= 1e-6 * (1 + std::abs(other)));
    }
  CHECK(compared >= count);
}

TEST_CASE(
    "Cone program: every iterate is strictly feasible, and the gap bounds the excess energy") {
  const Instance instance = random_instance(7, 8, 8, 60, true);
  ConeSettings settings = exact();
  const double best =
      solved(instance.system, instance.target, settings, from(instance.start)).energy;
  for (int iterations = 1; iterations <= 20; ++iterations) {
    settings.iterations = iterations;
    const ConeSolution stopped =
        solved(instance.system, instance.target, settings, from(instance.start));
    CHECK(is_feasible(instance.system, stopped.x));
    CHECK(stopped.iterations <= iterations);
    CHECK(stopped.energy >= best - 1e-7);
    // The gap bounds the distance to the minimum once the gradient vanishes.
    if (stopped.residual < 1e-6) CHECK(stopped.energy - best <= stopped.gap + 1e-5);
  }
}

TEST_CASE("Cone program: a warm start takes fewer iterations to the same minimum") {
  Instance instance = random_instance(3, 10, 10, 80, true);
  const ConeSolution first =
      solved(instance.system, instance.target, exact(), from(instance.start));
  instance.target.linear *= 1.01;
  const ConeSolution cold = solved(instance.system, instance.target, exact(), from(instance.start));
  ConeSolution start = first;
  start.x = 0.98 * first.x + 0.02 * instance.start;
  const ConeSolution warm = solved(instance.system, instance.target, exact(), start);
  CHECK(warm.iterations < cold.iterations);
  CHECK(std::abs(warm.energy - cold.energy) <= 1e-7);
}

TEST_CASE("Cone program: leaving rows out of the Hessian does not change the minimum") {
  const Instance instance = random_instance(11, 8, 8, 100, false);
  ConeSettings settings = exact();
  const double all =
      solved(instance.system, instance.target, settings, from(instance.start)).energy;
  settings.neglected = 0.1;
  const ConeSolution fewer =
      solved(instance.system, instance.target, settings, from(instance.start));
  CHECK(fewer.status == ConeSolution::Status::solved);
  CHECK(std::abs(fewer.energy - all) <= 1e-7);
}

TEST_CASE("Cone program: only heights, or only disks") {
  Instance box = random_instance(5, 6, 4, 30, false);
  box.system.re.resize(0, 30);
  box.system.im.resize(0, 30);
  box.system.quadratic = MatrixXd::Identity(6, 6);
  box.target.linear = VectorXd::Constant(6, -2);
  const ConeSolution heights = solved(box.system, box.target, exact(), from(VectorXd::Zero(6)));
  CHECK(heights.status == ConeSolution::Status::solved);
  CHECK(is_feasible(box.system, heights.x));
  Instance discs = random_instance(6, 4, 6, 30, false);
  discs.system.height.resize(0, 30);
  discs.system.fit.resize(0, 0);
  discs.system.cones = {{VectorXd::LinSpaced(30, 0.2, 1.0), 0, 0}};
  discs.system.quadratic = MatrixXd::Identity(6, 6);
  discs.target.linear = VectorXd::Constant(6, -2);
  const ConeSolution flat = solved(discs.system, discs.target, exact(), from(VectorXd::Zero(6)));
  CHECK(flat.status == ConeSolution::Status::solved);
  double tightest = 0;
  for (Index i = 0; i < 30; ++i)
    tightest = std::max(tightest, std::hypot(discs.system.re.col(i).dot(flat.x),
                                             discs.system.im.col(i).dot(flat.x)) /
                                      discs.system.cones[0].height(i, 0, 1));
  CHECK(tightest < 1);
  CHECK(tightest > 0.999);
}

}  // namespace holomorph::cone_program_test
