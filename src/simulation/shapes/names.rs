//! Other names of classes: those of VirtualHome, and what people say.

use super::{Class, classes};

/// Other names, without spaces, and the class that is drawn for them.
const OTHER_NAMES: &[(&str, &str)] = &[
    ("remotecontrol", "tv remote"),
    ("remote", "tv remote"),
    ("fridge", "refrigerator"),
    ("couch", "sofa"),
    ("loveseat", "sofa"),
    ("coffeemug", "mug"),
    ("cup", "mug"),
    ("waterglass", "glass"),
    ("wineglass", "glass"),
    ("dishbowl", "bowl"),
    ("fryingpan", "pan"),
    ("cookingpot", "pot"),
    ("saucepan", "pot"),
    ("coffeepot", "kettle"),
    ("coffeemaker", "coffee machine"),
    ("television", "tv"),
    ("computer", "computer tower"),
    ("cpuscreen", "monitor"),
    ("cellphone", "phone"),
    ("mobilephone", "phone"),
    ("wallphone", "phone"),
    ("tablelamp", "lamp"),
    ("desklamp", "lamp"),
    ("ceilinglamp", "ceiling lamp"),
    ("walllamp", "wall lamp"),
    ("garbagecan", "bin"),
    ("trashcan", "bin"),
    ("wastebasket", "bin"),
    ("kitchentable", "table"),
    ("diningtable", "table"),
    ("oventray", "tray"),
    ("papertray", "tray"),
    ("cutleryknife", "knife"),
    ("cutleryfork", "fork"),
    ("cutleryspoon", "spoon"),
    ("bookcase", "bookshelf"),
    ("shelf", "bookshelf"),
    ("closet", "wardrobe"),
    ("cabinet", "dresser"),
    ("chestofdrawers", "dresser"),
    ("bathroomcabinet", "wall cabinet"),
    ("kitchencabinets", "wall cabinet"),
    ("kitchencabinet", "wall cabinet"),
    ("kitchencounter", "counter"),
    ("bathroomcounter", "counter"),
    ("kitchensink", "sink"),
    ("washbasin", "sink"),
    ("cooker", "stove"),
    ("oven", "stove"),
    ("wallpictureframe", "painting"),
    ("picture", "painting"),
    ("photoframe", "picture frame"),
    ("potplant", "plant"),
    ("houseplant", "plant"),
    ("orchid", "plant"),
    ("bananas", "banana"),
    ("breadslice", "bread"),
    ("loaf", "bread"),
    ("lime", "lemon"),
    ("peach", "orange"),
    ("plum", "apple"),
    ("poundcake", "cake"),
    ("barsoap", "soap"),
    ("facecream", "jar"),
    ("hairproduct", "shampoo"),
    ("deodorant", "shampoo"),
    ("dishwashingliquid", "shampoo"),
    ("chocolatesyrup", "bottle"),
    ("condimentshaker", "salt shaker"),
    ("clothespile", "clothes"),
    ("clothesshirt", "clothes"),
    ("clothespants", "clothes"),
    ("shirt", "clothes"),
    ("curtains", "curtain"),
    ("carpet", "rug"),
    ("toiletroll", "toilet paper"),
    ("rubbishbin", "bin"),
    ("wallclock", "clock"),
    ("tub", "bathtub"),
    ("stovefan", "extractor hood"),
    ("folder", "book"),
    ("notebook", "book"),
    ("magazine", "book"),
    ("cushion", "pillow"),
    ("sidetable", "nightstand"),
    ("easychair", "armchair"),
    ("cupboard", "pantry"),
    ("trousers", "clothes"),
    ("teapot", "kettle"),
    ("larder", "pantry"),
    ("faucet", "tap"),
    ("shoe", "shoes"),
    ("slippers", "shoes"),
];

/// The class of this name, whatever its case, spaces, `_` and `-`.
pub fn class_named(name: &str) -> Option<&'static Class> {
    let plain = plain(name);
    let known = |plain: &str| classes().find(|class| self::plain(class.name) == *plain);
    known(&plain).or_else(|| {
        let (_, class) = OTHER_NAMES.iter().find(|(other, _)| *other == plain)?;
        classes().find(|known| known.name == *class)
    })
}

fn plain(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, ' ' | '_' | '-')).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_other_name_leads_to_a_class() {
        for (other, class) in OTHER_NAMES {
            assert!(classes().any(|known| known.name == *class), "{class}");
            assert!(!classes().any(|known| plain(known.name) == *other), "{other} is a class");
            assert_eq!(class_named(other).unwrap().name, *class);
        }
    }

    #[test]
    fn classes_are_named_once() {
        for class in classes() {
            assert_eq!(classes().filter(|other| other.name == class.name).count(), 1);
            assert_eq!(class_named(&class.name.to_uppercase()).unwrap().name, class.name);
        }
    }
}
