//! Scene files: the shipped ones build, wrong ones give one message in place, written ones come back with the same bits.

use tautline::scene::{self, Document};

#[test]
fn every_shipped_scene_builds_and_explains_itself() {
    for shipped in scene::shipped() {
        let setup = scene::open(shipped.name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(setup.title, shipped.title, "the list and the file of {} agree", shipped.name);
        assert!(setup.about.ends_with('.'), "{} says what to try", shipped.name);
        assert!(setup.view.is_some(), "{} says what to show", shipped.name);
        assert!(!setup.world.bodies().is_empty());
    }
    assert_eq!(scene::shipped()[0].name, "bridge", "the scene that opens by itself comes first");
}

#[test]
fn a_document_comes_back_from_its_text_unchanged() {
    for shipped in scene::shipped() {
        let document = Document::from_text(shipped.name, shipped.text).unwrap_or_else(|error| panic!("{error}"));
        let again = Document::from_text(shipped.name, &scene::to_ron(&document)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(document, again, "{}", shipped.name);
    }
}
