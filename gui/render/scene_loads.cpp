#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "render/scene.hpp"

// Loads and constraints in the picture.

namespace breccia::gui {
namespace {

using Colour = std::array<double, 3>;

/// Of LoadShape.
constexpr std::array<Colour, kNumLoadShapes> kLoads{{{0.0, 0.45, 0.70},
                                                     {0.75, 0.25, 0.55},
                                                     {0.80, 0.30, 0.0},
                                                     {0.15, 0.45, 0.25},
                                                     {0.75, 0.25, 0.55},
                                                     {0.55, 0.42, 0.0},
                                                     {0.42, 0.25, 0.75},
                                                     {0.25, 0.45, 0.50}}};

}  // namespace

void Scene::set_loads(std::vector<Load> loads) {
  loads_ = std::move(loads);
  draw_loads();
}

void Scene::show_loads(bool on) {
  shows_loads_ = on;
  draw_loads();
}

void Scene::draw_loads() {
  for (const auto& actor : glyphs_) renderer_->RemoveViewProp(actor);
  glyphs_.clear();
  words_.clear();
  num_glyphs_ = 0;
  if (!has_data() || !shows_loads_ || explode_ > 0) return;  // parts that are moved apart are not where loads act
  for (const Load& load : loads_) {
    LoadGlyphs drawn = draw_load(*frame_.skin, frame_.elements, groups_, surfaces_, load);
    if (drawn.count() == 0) continue;
    num_glyphs_ += drawn.count();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(drawn.mesh);
    if (drawn.inner) {                     // in front of everything: otherwise the model hides them
      constexpr double kInFront = -66000;  // units of the depth buffer's polygon offset, larger than all of it
      mapper->SetResolveCoincidentTopologyToPolygonOffset();
      mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0, kInFront);
    }
    const auto& actor = glyphs_.emplace_back(vtkSmartPointer<vtkActor>::New());
    actor->SetMapper(mapper);
    actor->PickableOff();
    const Colour& c = kLoads[static_cast<std::size_t>(load.shape)];
    actor->GetProperty()->SetColor(c[0], c[1], c[2]);
    actor->GetProperty()->SetAmbient(0.4);
    renderer_->AddViewProp(actor);
    words_.add(load.words, std::move(drawn.places));
  }
}

}  // namespace breccia::gui
