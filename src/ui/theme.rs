//! The tokens of the look: sizes, colours and type, each in one place, for the dark and the light theme.

use egui::{
    Color32, CornerRadius, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Vec2, Visuals,
    style::ScrollStyle,
};

/// Everything is a multiple of this [points].
pub const GRID: f32 = 4.0;
/// Height of a row of a panel [points].
pub const ROW: f32 = 24.0;
/// Height of the bar at the top [points].
pub const TOP_BAR: f32 = 40.0;
/// Side of a button that shows an icon [points].
pub const ICON_BUTTON: f32 = 28.0;
/// Width of the column of labels in a panel [points].
pub const LABEL_WIDTH: f32 = 104.0;
/// Width of the column of values in a panel [points].
pub const VALUE_WIDTH: f32 = 80.0;
/// Size of every text but headings and notes [points].
pub const BODY: f32 = 13.0;
/// Size of headings [points].
pub const HEADING: f32 = 16.0;
/// Size of notes and of the marks of an axis [points].
pub const SMALL: f32 = 11.0;

/// Light letters on dark grey, or dark on light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// Light letters on dark grey.
    #[default]
    Dark,
    /// Dark letters on light grey.
    Light,
}

/// The colours of a theme's panels; the scene has its own in `render::colour`. Greys are neutral, so that saturated colour
/// belongs to the physics; the accent alone marks what is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colours {
    /// Behind everything in the panels, menus and dialogs.
    pub panel: Color32,
    /// Behind a value that can be edited.
    pub field: Color32,
    /// Behind what lies under the pointer, is pressed or open.
    pub hover: Color32,
    /// Lines between panels and around fields.
    pub line: Color32,
    /// Letters and icons of usual weight.
    pub text: Color32,
    /// Labels and notes.
    pub weak: Color32,
    /// Headings, and letters under the pointer.
    pub strong: Color32,
    /// What is chosen, switched on or under way.
    pub accent: Color32,
    /// Letters and icons on the accent.
    pub on_accent: Color32,
    /// What a user should look at, without being wrong.
    pub warning: Color32,
    /// What passed.
    pub good: Color32,
    /// What failed.
    pub error: Color32,
    /// Behind the fault banner and the labels that lie on the scene.
    pub overlay: Color32,
    /// Curves: categorical, told apart by the colour-blind (Okabe and Ito 2008), adjusted to the background.
    pub series: [Color32; 6],
}

impl Theme {
    /// The other one.
    pub fn other(self) -> Theme {
        match self {
            Theme::Dark => Theme::Light,
            Theme::Light => Theme::Dark,
        }
    }

    /// The scene's theme of the same name.
    pub fn scene(self) -> crate::render::Theme {
        match self {
            Theme::Dark => crate::render::Theme::Dark,
            Theme::Light => crate::render::Theme::Light,
        }
    }

    /// The colours of this theme.
    pub fn colours(self) -> Colours {
        match self {
            Theme::Dark => DARK,
            Theme::Light => LIGHT,
        }
    }
}

const fn grey(level: u8) -> Color32 {
    Color32::from_gray(level)
}

const fn rgb(r: u8, g: u8, b: u8) -> Color32 {
    Color32::from_rgb(r, g, b)
}

const DARK: Colours = Colours {
    panel: grey(30),
    field: grey(44),
    hover: grey(58),
    line: grey(50),
    text: grey(216),
    weak: grey(154),
    strong: grey(245),
    accent: rgb(84, 150, 255),
    on_accent: grey(12),
    warning: rgb(240, 178, 72),
    good: rgb(0, 178, 130),
    error: rgb(245, 106, 96),
    overlay: Color32::from_rgba_premultiplied(26, 26, 26, 232),
    series: [
        rgb(86, 180, 233),
        rgb(230, 159, 0),
        rgb(0, 178, 130),
        rgb(235, 235, 235),
        rgb(214, 132, 178),
        rgb(222, 104, 44),
    ],
};

const LIGHT: Colours = Colours {
    panel: grey(240),
    field: grey(255),
    hover: grey(226),
    line: grey(212),
    text: grey(44),
    weak: grey(96),
    strong: grey(10),
    accent: rgb(24, 96, 214),
    on_accent: grey(255),
    warning: rgb(158, 96, 0),
    good: rgb(0, 120, 85),
    error: rgb(190, 36, 30),
    overlay: Color32::from_rgba_premultiplied(240, 240, 240, 240),
    series: [rgb(0, 114, 178), rgb(188, 120, 0), rgb(0, 130, 95), rgb(40, 40, 40), rgb(176, 84, 136), rgb(200, 80, 0)],
};

/// The colours of the theme that `ui` is drawn in.
pub fn colours(ui: &egui::Ui) -> Colours {
    if ui.visuals().dark_mode { DARK } else { LIGHT }
}

/// Gives `ctx` its fonts, and takes away the keys with which egui zooms its own text: they zoom the scene here.
pub fn install(ctx: &egui::Context) {
    let mut fonts = FontDefinitions::default();
    // Arrows are in the monospaced font only.
    fonts.families.entry(FontFamily::Proportional).or_default().push("Hack".to_owned());
    ctx.set_fonts(fonts);
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
}

/// Makes every widget of `ctx` follow the tokens.
pub fn apply(ctx: &egui::Context, theme: Theme) {
    let egui_theme = match theme {
        Theme::Dark => egui::Theme::Dark,
        Theme::Light => egui::Theme::Light,
    };
    ctx.set_theme(egui_theme);
    ctx.style_mut_of(egui_theme, |style| {
        style.visuals = visuals(theme);
        style.text_styles = [
            (TextStyle::Small, FontId::proportional(SMALL)),
            (TextStyle::Body, FontId::proportional(BODY)),
            (TextStyle::Button, FontId::proportional(BODY)),
            (TextStyle::Monospace, FontId::monospace(BODY - 1.0)),
            (TextStyle::Heading, FontId::proportional(HEADING)),
        ]
        .into();
        let spacing = &mut style.spacing;
        spacing.item_spacing = Vec2::splat(GRID);
        spacing.button_padding = Vec2::new(2.0 * GRID, 2.0);
        spacing.interact_size = Vec2::new(ROW, ROW - GRID);
        spacing.menu_margin = Margin::same(GRID as i8);
        spacing.slider_rail_height = GRID;
        spacing.tooltip_width = 320.0;
        spacing.icon_width = 16.0;
        // Solid: beside what it scrolls and not over it, and seen before the pointer is there.
        spacing.scroll = ScrollStyle {
            bar_width: 1.5 * GRID,
            bar_inner_margin: GRID,
            foreground_color: true,
            ..ScrollStyle::solid()
        };
        style.interaction.tooltip_delay = 0.35;
        style.interaction.selectable_labels = false;
    });
}

fn visuals(theme: Theme) -> Visuals {
    let c = theme.colours();
    let mut visuals = match theme {
        Theme::Dark => Visuals::dark(),
        Theme::Light => Visuals::light(),
    };
    let radius = CornerRadius::same(GRID as u8);
    let widgets = &mut visuals.widgets;
    for (widget, fill, text, border) in [
        (&mut widgets.noninteractive, c.panel, c.text, c.line),
        (&mut widgets.inactive, c.field, c.text, c.line),
        (&mut widgets.hovered, c.hover, c.strong, c.weak),
        (&mut widgets.active, c.hover, c.strong, c.accent),
        (&mut widgets.open, c.hover, c.strong, c.line),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.bg_stroke = Stroke::new(1.0, border);
        widget.corner_radius = radius;
        widget.expansion = 0.0;
    }
    visuals.panel_fill = c.panel;
    visuals.window_fill = c.panel;
    visuals.window_stroke = Stroke::new(1.0, c.line);
    visuals.window_corner_radius = CornerRadius::same(2 * GRID as u8);
    visuals.menu_corner_radius = radius;
    visuals.window_shadow = Shadow { offset: [0, 8], blur: 24, spread: 0, color: Color32::from_black_alpha(96) };
    visuals.popup_shadow = Shadow { offset: [0, 4], blur: 12, spread: 0, color: Color32::from_black_alpha(80) };
    visuals.extreme_bg_color = c.field;
    visuals.faint_bg_color = c.field;
    visuals.weak_text_color = Some(c.weak);
    visuals.selection.bg_fill = c.accent;
    visuals.selection.stroke = Stroke::new(1.0, c.on_accent);
    visuals.hyperlink_color = c.accent;
    visuals.warn_fg_color = c.warning;
    visuals.error_fg_color = c.error;
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = egui::style::HandleShape::Circle;
    visuals.text_cursor.stroke = Stroke::new(1.5, c.accent);
    visuals
}
