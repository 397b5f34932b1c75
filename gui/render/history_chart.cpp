#include "render/history_chart.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkContextActor.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotLine.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>

namespace breccia::gui {
namespace {

struct Look {
  std::array<unsigned char, 3> colour;
  int pen;  // so that curves are told apart without colour
};

constexpr std::array<Look, 8> kLooks{{{{0, 114, 178}, vtkPen::SOLID_LINE},
                                      {{213, 94, 0}, vtkPen::SOLID_LINE},
                                      {{0, 158, 115}, vtkPen::SOLID_LINE},
                                      {{204, 121, 167}, vtkPen::SOLID_LINE},
                                      {{230, 159, 0}, vtkPen::DASH_LINE},
                                      {{86, 180, 233}, vtkPen::DASH_LINE},
                                      {{140, 140, 140}, vtkPen::DASH_LINE},
                                      {{200, 30, 30}, vtkPen::DOT_LINE}}};

vtkSmartPointer<vtkDoubleArray> column(const std::string& name, const std::vector<double>& values, double scale) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  for (const double x : values) array->InsertNextValue(scale * x);
  return array;
}

}  // namespace

HistoryChart::HistoryChart() {
  vtkNew<vtkContextActor> actor;
  scene_ = actor->GetScene();
  scene_->AddItem(chart_);
  scene_->SetRenderer(renderer_);
  renderer_->AddActor(actor);
  chart_->SetShowLegend(true);
  chart_->GetLegend()->SetInline(false);  // beside the curves, not over them
  chart_->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  chart_->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  chart_->SetBorders(20, 20, 16, 10);  // at the right: half of the last label
  chart_->GetAxis(vtkAxis::BOTTOM)->SetTitle("time [us]");
  set_dark(false);
}

void HistoryChart::show(const std::vector<double>& time, const std::vector<Curve>& curves,
                        const std::string& value_axis) {
  constexpr double kMicro = 1e6;
  chart_->ClearPlots();
  chart_->GetAxis(vtkAxis::LEFT)->SetTitle(value_axis);
  if (time.size() < 2) return;  // a line needs two points
  std::size_t number = 0;
  for (const Curve& curve : curves) {
    const std::vector<double>& own = curve.time.empty() ? time : curve.time;
    if (curve.values.size() != own.size() || own.size() < 2) continue;
    vtkNew<vtkTable> table;
    table->AddColumn(column("time", own, kMicro));
    table->AddColumn(column(curve.name, curve.values, 1));
    vtkPlot* line = chart_->AddPlot(vtkChart::LINE);
    line->SetInputData(table, 0, 1);
    const Look& look = kLooks[number++ % kLooks.size()];
    line->SetColor(look.colour[0], look.colour[1], look.colour[2], 255);
    line->GetPen()->SetLineType(curve.time.empty() ? look.pen : vtkPen::DASH_DOT_LINE);
    line->SetWidth(2);
  }
  chart_->RecalculateBounds();
}

void HistoryChart::set_dark(bool dark) {
  const double paper = dark ? 0.13 : 1.0, ink = dark ? 0.92 : 0.1;
  renderer_->SetBackground(paper, paper, paper);
  for (const int side : {vtkAxis::LEFT, vtkAxis::BOTTOM}) {
    vtkAxis* axis = chart_->GetAxis(side);
    axis->GetTitleProperties()->SetColor(ink, ink, ink);
    axis->GetTitleProperties()->SetBold(0);
    axis->GetTitleProperties()->SetFontSize(12);
    axis->GetLabelProperties()->SetColor(ink, ink, ink);
    axis->GetLabelProperties()->SetFontSize(11);
    axis->GetPen()->SetColorF(ink, ink, ink);
    axis->GetGridPen()->SetColorF(0.5, 0.5, 0.5, 0.3);
  }
  chart_->GetLegend()->GetLabelProperties()->SetColor(ink, ink, ink);
  chart_->GetLegend()->GetLabelProperties()->SetFontSize(11);
  chart_->GetLegend()->GetBrush()->SetColorF(paper, paper, paper, 0.8);
}

}  // namespace breccia::gui
