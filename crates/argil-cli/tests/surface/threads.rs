//! What a program keeps can be handed to another thread, and looked at from several.
//!
//! Left out are what borrows a function of the caller's, which may be bound to its thread, and what is made behind petgraph's feature, which
//! the program does not have.

/// Compiles for such types alone.
fn shared<T: Send + Sync>() -> &'static str {
    std::any::type_name::<T>()
}

macro_rules! shared {
    ($($type:ty),* $(,)?) => {
        [$(shared::<$type>()),*]
    };
}

#[rustfmt::skip]
pub(crate) fn types() -> impl IntoIterator<Item = &'static str> {
    shared![
        // argil-audit
        argil_audit::Amount,
        argil_audit::AuditError,
        argil_audit::AuditSettings,
        argil_audit::ContactCause,
        argil_audit::ContactPlace,
        argil_audit::Finding,
        argil_audit::FindingKind,
        argil_audit::Report,
        argil_audit::Shortfall,
        // argil-calibrate
        argil_calibrate::CalibrateError,
        argil_calibrate::Calibration,
        // argil-curve
        argil::curve::ArcSpan,
        argil::curve::ClosedCurve,
        argil::curve::Crossing,
        argil::curve::CrossingKind,
        argil::curve::CurveError,
        argil::curve::NearestOnCurve,
        argil::curve::NearestOnSegment,
        argil::curve::NearestSegment,
        argil::curve::OnCurve,
        argil::curve::PointIndex,
        argil::curve::Segment,
        argil::curve::SegmentIndex,
        argil::curve::SegmentPart,
        // argil-elastic
        argil::elastic::Carrier,
        argil::elastic::ElasticError,
        argil::elastic::ElasticOptions,
        argil::elastic::ElasticSolver,
        argil::elastic::ImlsField,
        argil::elastic::Relaxed,
        argil::elastic::Stop,
        // argil-fill
        argil::fill::BareDisc,
        argil::fill::Bead,
        argil::fill::Figures,
        argil::fill::Fill,
        argil::fill::FillCurve,
        argil::fill::FillError,
        argil::fill::FillOptions,
        argil::fill::FillPattern,
        argil::fill::Joint,
        argil::fill::Merged,
        argil::fill::Ring,
        // argil-gcode
        argil::gcode::BadLine,
        argil::gcode::Extrusion,
        argil::gcode::Fault,
        argil::gcode::Flavour,
        argil::gcode::Gcode<'static>,
        argil::gcode::GcodeError,
        argil::gcode::GcodeSettings,
        argil::gcode::Move,
        argil::gcode::Poses<'static>,
        argil::gcode::Program,
        argil::gcode::RoleNames,
        // argil-graph
        argil::graph::DistanceLabels<'static>,
        argil::graph::DistanceMatrix,
        argil::graph::Distances<'static>,
        argil::graph::FreeSpace<'static>,
        argil::graph::GraphError,
        argil::graph::Nodes<'static>,
        argil::graph::PathFinder<'static>,
        argil::graph::PathGraph,
        argil::graph::PointKind,
        // argil-layers
        argil_layers::Layers,
        argil_layers::LayersError,
        argil_layers::SvgSettings,
        // argil-mesh
        argil::mesh::Bounds,
        argil::mesh::EdgeTable,
        argil::mesh::Format,
        argil::mesh::Ground,
        argil::mesh::Mesh,
        argil::mesh::MeshError,
        argil::mesh::Placement,
        argil::mesh::Places,
        argil::mesh::Remark,
        argil::mesh::Repairs,
        argil::mesh::Size,
        argil::mesh::Soup,
        argil::mesh::Unit,
        // argil-models
        argil_models::Bounds,
        argil_models::Field,
        argil_models::ModelError,
        argil_models::Solid,
        // argil-preview
        argil_preview::CleaningStyle,
        argil_preview::Colour,
        argil_preview::CutPlace,
        argil_preview::PageMark,
        argil_preview::PageStyle,
        argil_preview::Palette,
        argil_preview::PreviewError,
        argil_preview::SvgStyle,
        argil_preview::ViewStyle,
        // argil-printers
        argil_printers::Bead,
        argil_printers::Fact<f64>,
        argil_printers::Flavour,
        argil_printers::Material,
        argil_printers::Origin,
        argil_printers::Printer,
        argil_printers::ProfileError,
        argil_printers::Volume,
        // argil-route
        argil::route::Cycle,
        argil::route::Demand,
        argil::route::LayerInput<'static>,
        argil::route::Leg,
        argil::route::Region,
        argil::route::RouteError,
        argil::route::RouteSettings,
        argil::route::Router,
        argil::route::ShortestTours,
        argil::route::SplicedRouter,
        argil::route::TourDistances,
        argil::route::Wall<'static>,
        // argil-safeguard
        argil::safeguard::SafeguardSettings,
        // argil-seam
        argil::seam::SeamError,
        argil::seam::SeamSettings,
        // argil-skin
        argil::skin::Bumps,
        argil::skin::Filled,
        argil::skin::ModelLoop,
        argil::skin::Section<'static>,
        argil::skin::SkinOptions,
        argil::skin::Stripes,
        // argil-slice
        argil::slice::Layer,
        argil::slice::Loss,
        argil::slice::SliceError,
        argil::slice::SliceSettings,
        argil::slice::WallLoop,
        // argil-strand
        argil::strand::BeadShape,
        argil::strand::LayerSummary,
        argil::strand::Move,
        argil::strand::Rise,
        argil::strand::Role,
        argil::strand::RoleLengths,
        argil::strand::Step,
        argil::strand::Strand,
        argil::strand::StrandError,
        argil::strand::StrandLayer,
        argil::strand::SupportSource,
        // argil-support
        argil::support::Criterion,
        argil::support::Placement,
        argil::support::SupportPoint,
        // argil-taut
        argil::taut::TautOptions,
        // argil-tour
        argil::tour::MatrixMetric<'static>,
        argil::tour::Tour,
        argil::tour::TourError,
        argil::tour::TourOptions,
        argil::tour::TourSolver,
        // argil
        argil::Bed,
        argil::Climb,
        argil::Document<argil::Settings>,
        argil::LayerFault,
        argil::Infill,
        argil::InfillChoice,
        argil::LayerReport,
        argil::LevelCause,
        argil::Material,
        argil::Plan,
        argil::PlanError,
        argil::Planner,
        argil::Progress,
        argil::Settings,
        argil::Skirt,
        argil::SkirtLaid,
        argil::WallOrder,
        argil::StageTimes,
        argil::literal::LiteralElastic,
        argil::literal::NearestStarts,
        argil::literal::SplicedRoute,
        argil::literal::StrideSupport,
        argil::stages::BestChain,
        argil::stages::ElasticCurve,
        argil::stages::Excursions,
        argil::stages::ExcursionsBy<argil::route::ShortestTours>,
        argil::stages::FewestPoints,
        argil::stages::LeftSlack,
        argil::stages::PlaneSlices,
        argil::stages::PulledTaut,
        argil::stages::SlopedSafeguard,
    ]
}

/// What may be bound to a thread, and why: see above.
pub(crate) const BOUND: [&str; 4] = ["Edges", "Path", "SeenFrom", "SlackPath"];
