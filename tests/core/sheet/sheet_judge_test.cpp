// Newton's method of the elastic sheet against an independent solver, Ipopt, with values and slopes
// alone.
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>

#include "core/mesh/mesher.h"
#include "core/sheet/sheet_program.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::sheet_judge_test {

namespace {

class Problem final : public Ipopt::TNLP {
 public:
  VectorXc f;  ///< the start, and then the minimum

  Problem(const SheetProgram& program, const SheetPull& pull, VectorXc start)
      : f(std::move(start)), program_(program), pull_(pull) {}

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Ipopt::Index>(2 * f.size());
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
  bool get_starting_point(Ipopt::Index n, bool, double* x, bool, double*, double*, Ipopt::Index,
                          bool, double*) override {
    const double* from = reinterpret_cast<const double*>(f.data());
    std::copy(from, from + n, x);
    return true;
  }
  bool eval_f(Ipopt::Index n, const double* x, bool, double& value) override {
    value = program_.value(map_of(n, x), pull_);
    return std::isfinite(value);  // Ipopt takes a shorter step
  }
  bool eval_grad_f(Ipopt::Index n, const double* x, bool, double* slopes) override {
    const VectorXd all = program_.gradient(map_of(n, x), pull_);
    std::copy(all.begin(), all.end(), slopes);
    return true;
  }
  bool eval_g(Ipopt::Index, const double*, bool, Ipopt::Index, double*) override { return true; }
  bool eval_jac_g(Ipopt::Index, const double*, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index*,
                  Ipopt::Index*, double*) override {
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index n, const double* x, const double*,
                         const double*, Ipopt::Index, const double*, const double*, double,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    f = map_of(n, x);
  }

 private:
  static VectorXc map_of(Ipopt::Index n, const double* x) {
    return Eigen::Map<const VectorXc>(reinterpret_cast<const Complex*>(x), n / 2);
  }

  const SheetProgram& program_;
  const SheetPull& pull_;
};

}  // namespace

TEST_CASE("Sheet: Ipopt finds the same maps on small meshes") {
  for (const unsigned seed : seeds_of("sheets for Ipopt", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Cage cage = polygon_cage(shapes::star(5 + static_cast<int>(seed % 4), 0.3, seed));
    const auto mesh = std::make_shared<const Mesh>(domain_mesh(cage, {60}));
    const double size = box_of(mesh->vertices).diagonal();
    const auto count = static_cast<Index>(mesh->vertices.size());
    const auto sheet = std::make_shared<const SheetEnergy>(
        mesh, VectorXd::Ones(static_cast<Index>(mesh->triangles.size())),
        VectorXd::Constant(count, 0.04 * size));
    SheetHolds holds;
    SheetPull pull;
    for (int p = 0; p < 3; ++p) {
      const int v = static_cast<int>(random() % mesh->vertices.size());
      holds.rows.push_back({{{v, 1.0}}, 1e3 / (size * size)});
      pull.targets.push_back(mesh->vertices[static_cast<size_t>(v)] +
                             0.1 * size * random_complex(random));
    }
    const SheetProgram program(sheet, holds);
    const VectorXc rest = Eigen::Map<const VectorXc>(mesh->vertices.data(), count);
    VectorXc ours = rest;
    program.minimize(pull, ours, 100);

    Ipopt::SmartPtr<Problem> problem = new Problem(program, pull, rest);
    Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = IpoptApplicationFactory();
    ipopt->Options()->SetIntegerValue("print_level", 0);
    ipopt->Options()->SetStringValue("sb", "yes");
    ipopt->Options()->SetStringValue("hessian_approximation", "limited-memory");
    ipopt->Options()->SetIntegerValue("max_iter", 3000);
    ipopt->Options()->SetNumericValue("tol", 1e-9);
    REQUIRE(ipopt->Initialize() == Ipopt::Solve_Succeeded);
    ipopt->OptimizeTNLP(problem);
    const double theirs = program.value(problem->f, pull), value = program.value(ours, pull);
    CAPTURE(theirs, value);
    CHECK(std::abs(theirs - value) < 1e-7 * value);
    CHECK((problem->f - ours).cwiseAbs().maxCoeff() < 1e-3 * size);
  }
}

}  // namespace holomorph::sheet_judge_test
