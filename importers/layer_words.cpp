#include "importers/layer_words.h"

#include "engine/base/text.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace lightwell {
namespace {

struct Idea {
    const char* idea;
    const char* words; ///< folded; four capitals of the AIA lists are words like all others
};

/// What words mean. Words with `=` in front, and those of fewer than four letters, count only alone, never inside a
/// compound (`carp` is carpet in the AIA lists, but a carport is none).
constexpr Idea ideas[] = {
    // --- not for light
    {"annotation",
     "=text =texts txt =texte =texto =testo =anno annotation annotations =dims dimension dimensions =note =notes "
     "=symb symbol symbols =iden =patt hatch hatching schraffur bemassung beschriftung =cotas cotes =quote "
     "=title =ttlb defpoints viewport viewports axis axes achse achsen 标注 文字 尺寸 轴线"},
    // --- words that would be mistaken for others
    {"ignored", "texture textured lightweight glasswool glaswolle steinwolle autocad automatic floorplan carport "
                "carpark carpentry standard polizei"},
    // --- parts of buildings
    {"wall", "wall walls wand wande waende mauer mauern mauerwerk mur murs muro muros muri pared paredes parete pareti "
             "墙 墙体 墙面"},
    {"partition", "partition partitions =prtn =tptn trennwand trennwande trennwaende cloison cloisons tabique tabiques "
                  "tramezzo tramezzi 隔墙 隔断"},
    {"exterior", "exterior external =extr aussen exterieur exterieure exteriores esterno esterna esterni 外"},
    {"facade", "facade facades fassade fassaden fachada facciata cladding 立面"},
    {"curtainwall", "curtainwall curtainwalls curtainwalling vorhangfassade 幕墙"},
    {"curt", "=curt"},
    {"floor",
     "floor floors flooring =flor boden boeden fussboden bodenbelag sol sols plancher =piso =pisos suelo suelos "
     "pavimento pavimenti pavimentazione 地面 地板 楼面 地坪"},
    {"slab", "slab slabs dalle dalles losa losas forjado solaio solai bodenplatte platte geschossdecke 楼板"},
    {"ceiling", "ceiling ceilings =clng decke decken unterdecke plafond plafonds techo techos cielorraso soffitto "
                "soffitti controsoffitto controsoffitti soffit 天花 天花板 吊顶 顶棚"},
    {"acoustic", "acoustic acoustical akustik acoustique acustico acustica 吸音"},
    {"roof", "roof roofs roofing dach daecher dacher toit toits toiture toitures tejado cubierta techumbre tetto tetti "
             "copertura 屋顶 屋面"},
    {"door", "door doors tur turen tuer tueren porte portes puerta puertas porta 门"},
    {"window",
     "window windows casement casements =wndw fenster fenetre fenetres ventana ventanas finestra finestre 窗 窗户"},
    {"skylight", "skylight skylights rooflight rooflights =sklt oberlicht oberlichter dachfenster lichtkuppel lucarne "
                 "lucernario lucernari claraboya 天窗"},
    {"frame", "frame frames framing =fram mullion mullions =jamb rahmen zarge zargen pfosten chassis menuiserie "
              "menuiseries marco marcos carpinteria infisso infissi telaio telai serramento serramenti 窗框 门框 框"},
    {"sill", "sill fensterbank appui alfeizar davanzale 窗台"},
    {"stair", "stair stairs staircase =strs =step =steps =risr treppe treppen stufe stufen escalier escaliers escalera "
              "escaleras scala scalinata ramp ramps rampe rampa 楼梯 台阶 坡道"},
    {"railing", "=rail =rails railing railings handrail handrails guardrail balustrade balustrades =hral gelander "
                "gelaender bruestung brustung handlauf rambarde barandilla barandillas baranda ringhiera ringhiere "
                "parapetto parapet 栏杆 扶手"},
    {"column", "column columns =cols pillar pillars stutze stuetze saule saeule poteau poteaux pilier columna columnas "
               "pilar pilares pilastro pilastri colonna colonne 柱"},
    {"beam",
     "beam beams =jois joist joists girder truss balken trager traeger unterzug poutre poutres viga vigas trave "
     "travi 梁"},
    {"rafter", "rafter rafters sparren dachstuhl chevron chevrons"},
    {"sunshade", "=shad sunshade sunshades lightshelf brisesoleil sonnensegel 遮阳板"},
    {"foundation", "foundation foundations =fndn footing fundament fundamente fondation fondations cimentacion "
                   "fondazione fondazioni 基础"},
    {"furniture",
     "furniture furnishing furnishings =furn wdwk casework millwork mobel moebel mobilier meuble meubles "
     "mueble muebles mobiliario arredo arredi arredamento mobili desk desks table tables tisch tische "
     "=mesa =mesas tavolo tavoli schreibtisch bureau chair chairs =seat seating stuhl stuehle chaise chaises "
     "=silla sillas sedia sedie cabinet cabinets cupboard wardrobe closet schrank schraenke armoire "
     "armario armadio shelf shelves shelving regal regale etagere estante estanteria scaffale libreria "
     "bookcase bed beds bett betten =cama letto letti bench counter =case 家具 桌 桌子 椅 椅子 柜 床 书架"},
    {"sofa", "sofa sofas couch upholstery polster canape divano divani sillon sillones 沙发"},
    {"kitchen", "kitchen kitchens kuche kueche cuisine cocina cucina 厨房 橱柜"},
    {"sanitary", "sanitary sink sinks toilet toilets =bath bathtub basin washbasin lavatory lavabo lavabos urinal wc "
                 "=fixt waschbecken badewanne sanitar sanitaer sanitaire sanitaires sanitario sanitarios sanitari 洁具 "
                 "卫生洁具 马桶"},
    {"equipment", "equipment =eqpm appliance appliances machine machinery hvac duct ducts pipe pipes piping radiator "
                  "heizkorper heizkoerper lueftung luftung rohr rohre kanal equipement equipements equipo equipos "
                  "equipamiento impianto impianti tubo tubi tubazioni 设备 管道 风管"},
    {"elevator", "elevator elevators =evtr =lift aufzug ascenseur ascensor ascensore 电梯"},
    {"skirting", "skirting baseboard sockelleiste fussleiste plinthe rodapie zocalo battiscopa 踢脚"},
    // --- light
    {"light",
     "lights lighting =lite luminaire luminaires lightfixture lightfixtures leuchte leuchten beleuchtung licht "
     "lichter eclairage lumiere lumieres luminaria luminarias iluminacion luz luces illuminazione luce luci "
     "led leds lamp lamps lampe lampen lampes lampara lamparas lampada lampade apparecchio apparecchi 灯 灯具 照明"},
    {"lightword", "light"},
    {"bulb", "bulb bulbs gluhbirne gluehbirne ampoule bombilla lampadina 灯泡"},
    {"spot",
     "=spot =spots spotlight spotlights downlight downlights strahler einbaustrahler faretto faretti foco focos "
     "筒灯 射灯"},
    {"fluorescent", "fluorescent leuchtstoffrohre leuchtstoffroehre neon fluorescente 荧光灯"},
    {"strip", "=strip lichtband ledstrip bandeau 灯带"},
    {"candle", "candle candles kerze kerzen bougie =vela candela 蜡烛"},
    {"exit", "=exit notausgang rettungszeichen 出口"},
    {"screen", "screen screens monitor monitors display displays tv television fernseher bildschirm ecran ecrans "
               "pantalla pantallas schermo schermi 屏幕 电视 显示器"},
    {"lightbox", "lightbox leuchtkasten 灯箱"},
    {"pole", "=pole =poles =post housing =mast gehause gehaeuse 灯杆"},
    // --- glass and shading
    {"glass", "glass glas verre verres vidrio vidrios vetro vetri cristal cristales 玻璃"},
    {"glazing", "glazing =glaz glazed verglasung isolierglas isolierverglasung vitrage vitrages vitre vitree vitrees "
                "vitrine acristalamiento vetrata "
                "vetrate 门窗玻璃"},
    {"frosted", "frosted sandblasted etched obscure obscured satin satinato satiniert milchglas mattglas depoli opaco "
                "esmerilado 磨砂"},
    {"opal", "opal opaline 乳白"},
    {"translucent", "translucent transluzent translucide translucido traslucido 半透明"},
    {"tinted", "tinted getont getoent teinte tintado colorato 有色"},
    {"bronze", "bronze bronzo bronce"},
    {"lowe", "lowe low 低辐射"},
    {"double", "double doppelt doppel isolierglas isolierverglasung doble doppio 双层 中空"},
    {"triple", "triple dreifach triplo 三层"},
    {"single", "single einfach simple singolo 单层"},
    {"reflective", "reflective reflektierend reflechissant reflectante riflettente 反射"},
    {"mirror", "mirror mirrors =mirr spiegel miroir miroirs espejo espejos specchio specchi 镜 镜子"},
    {"acrylic",
     "acrylic plexiglas plexiglass plexi pmma acryl acrylglas acrylique acrilico metacrilato perspex 亚克力"},
    {"polycarbonate", "polycarbonate polycarbonat policarbonato stegplatte 聚碳酸酯"},
    {"etfe", "etfe"},
    {"membrane", "membrane membran membrana =tent zelt 膜"},
    {"blind", "blind blinds rollo rollos jalousie jalousien raffstore lamelle lamellen markise sonnenschutz shade "
              "shades shading louver louvers louvre louvres persienne persiennes persiana persianas tapparella "
              "tapparelle veneziana sunscreen volet volets 百叶 百叶窗 遮阳 卷帘"},
    {"curtain", "curtain curtains drape drapes vorhang vorhange vorhaenge gardine gardinen rideau rideaux cortina "
                "cortinas tenda tende 窗帘"},
    // --- materials
    {"concrete", "concrete =conc beton stahlbeton sichtbeton hormigon concreto calcestruzzo 混凝土 砼"},
    {"screed", "screed cement cemento ciment estrich chape zement 水泥"},
    {"brick", "brick bricks =brik brickwork masonry =masn ziegel klinker backstein brique briques ladrillo ladrillos "
              "mattone mattoni laterizio laterizi 砖 砖墙"},
    {"sandlime", "kalksandstein sandlime calciumsilicate"},
    {"block", "block blocks blockwork cmu cinder betonstein parpaing parpaings bloque bloques blocchi 砌块"},
    {"stone", "stone stones naturstein =stein pierre pierres piedra pietra 石 石材"},
    {"limestone", "limestone kalkstein calcaire caliza calcare travertine travertin travertino 石灰石"},
    {"sandstone", "sandstone sandstein gres arenisca arenaria 砂岩"},
    {"granite", "granite granit granito 花岗岩 花岗石"},
    {"marble", "marble marmor marbre marmol marmo 大理石"},
    {"slate", "slate schiefer ardoise pizarra ardesia 板岩"},
    {"terracotta", "terracotta terrakotta dachziegel tuile tuiles teja tejas tegola tegole 瓦"},
    {"plaster", "plaster =plst putz platre revoque enlucido intonaco stucco 抹灰 灰泥"},
    {"render", "render aussenputz enduit 外墙涂料"},
    {"gypsum", "gypsum gwb =gyps drywall plasterboard gips gipskarton placo placoplatre yeso pladur gesso "
               "cartongesso 石膏 石膏板"},
    {"tile", "tile tiles fliese fliesen kachel kacheln carrelage carreau carreaux azulejo azulejos baldosa baldosas "
             "piastrella piastrelle ceramic ceramics keramik ceramique ceramica 瓷砖 地砖 陶瓷"},
    {"wood", "wood wooden timber holz bois madera legno lumber veneer furnier plywood sperrholz contreplaque mdf osb "
             "木 木材 木质"},
    {"parquet", "parquet parkett parchet tarima dielen dielenboden hardwood 木地板 实木地板"},
    {"laminate", "laminate laminat stratifie laminado laminato melamine 复合"},
    {"oak", "oak eiche chene roble rovere quercia 橡木"},
    {"walnut", "walnut nussbaum noyer =nogal =noce 胡桃木"},
    {"birch", "birch birke bouleau abedul betulla 桦木"},
    {"maple", "maple ahorn erable =arce 枫木"},
    {"beech", "beech buche hetre =haya faggio 山毛榉"},
    {"pine", "pine kiefer fichte spruce =fir pin pino abete sapin larch larche laerche 松木"},
    {"mahogany", "mahogany mahagoni acajou caoba mogano 红木"},
    {"carpet",
     "carpet carpets =carp teppich teppiche teppichboden moquette tapis moqueta alfombra tappeto rug rugs 地毯"},
    {"linoleum", "linoleum =lino vinyl pvc vinilo vinile 油毡 塑胶"},
    {"rubber", "rubber gummi kautschuk caoutchouc caucho goma gomma 橡胶"},
    {"leather", "leather leder cuir cuero pelle cuoio 皮革"},
    {"fabric", "fabric fabrics textile textil stoff tissu tela tejido tessuto cloth 布 织物"},
    {"plastic", "plastic plastics kunststoff plastik plastique plastico plastica 塑料"},
    {"paper", "paper =papier =papel =carta 纸"},
    {"steel", "steel =stel stahl acier acero acciaio 钢 钢材"},
    {"stainless", "stainless edelstahl inox inoxydable inoxidable inossidabile 不锈钢"},
    {"aluminium", "aluminium aluminum =alum alu alumin aluminio alluminio 铝 铝合金"},
    {"copper", "copper kupfer cuivre =cobre =rame 铜"},
    {"brass", "brass messing laiton laton ottone 黄铜"},
    {"chrome", "chrome chrom chromed cromo verchromt 铬"},
    {"gold", "=gold golden gilded vergoldet doro oro 金色"},
    {"zinc", "zinc zink titanzink 锌"},
    {"corten", "corten cortenstahl weathering 耐候钢"},
    {"metal",
     "metal metals =metl sandwich metall metallic blech tole chapa lamiera metallo metallique iron eisen fer hierro "
     "ferro 金属 铁"},
    {"brushed", "brushed geburstet gebuerstet brosse cepillado spazzolato 拉丝"},
    {"polished", "polished poliert =poli pulido lucidato 抛光"},
    {"anodised", "anodised anodized eloxiert anodise anodizado anodizzato 阳极氧化"},
    {"patina", "patina verdigris grunspan"},
    {"painted", "painted lackiert gestrichen peint pintado verniciato"},
    {"paint", "paint paints =pnts anstrich farbe farben peinture pintura vernice pittura =lack 涂料 乳胶漆 油漆"},
    {"porcelain", "porcelain porzellan porcelaine porcelana porcellana 瓷"},
    // --- colours
    {"white", "white weiss =blanc blanche blanco blanca bianco bianca 白 白色"},
    {"black", "black schwarz noir noire negro negra nero nera 黑 黑色"},
    {"grey", "grey gray grau gris grise grigio grigia 灰 灰色"},
    {"red", "red rot =rouge rojo =roja rosso rossa 红 红色"},
    {"yellow", "yellow gelb jaune amarillo amarilla giallo gialla 黄 黄色"},
    {"green", "green grun gruen =vert verte verde verdi 绿 绿色"},
    {"blue", "blue blau bleu bleue azul blu azzurro 蓝 蓝色"},
    {"brown", "brown braun brun brune marron marrone 棕 褐"},
    {"cream", "cream creme beige ivory elfenbein crema avorio 米色"},
    {"pale", "pale hell heller helle clair claire =claro clara chiaro chiara 浅 浅色"},
    {"dark", "dark dunkel dunkle fonce foncee oscuro oscura scuro scura 深 深色"},
    // --- outdoors
    {"ground", "ground =grnd =site terrain =topo topography gelande gelaende terreno terreni earth 地形 场地 室外地面"},
    {"soil", "soil =erde erdreich =terre =tierra =terra mulch 土 土壤"},
    {"asphalt", "asphalt asphalte bitumenstrasse asfalto bitume tarmac macadam 沥青"},
    {"road",
     "=road roads street driveway parking =pkng =pvmt strasse strassen fahrbahn parkplatz route chaussee voirie "
     "calle carretera estacionamiento strada strade parcheggio 道路 马路 停车场"},
    {"park", "=park =parks"},
    {"paving", "=pave paving pavement pavers sidewalk walk walkway footpath gehweg pflaster pflasterung trottoir acera "
               "marciapiede terrace terrasse terraza terrazza =patio 人行道 铺装 广场"},
    {"gravel", "gravel kies schotter gravier grava ghiaia 砾石 碎石"},
    {"sand", "sand =sable =arena sabbia 沙"},
    {"grass", "grass lawn turf rasen wiese =gras gazon pelouse herbe cesped hierba =prato erba landscape 草 草地 草坪"},
    {"plant", "plant plants =plnt planting vegetation shrub shrubs hedge hedges bush foliage leaves pflanze pflanzen "
              "hecke strauch begrunung begruenung plante plantes haie planta plantas arbusto seto pianta piante siepe "
              "植物 绿化 灌木"},
    {"tree", "tree trees baum baume baeume arbre arbres arbol arboles albero alberi 树 树木 乔木"},
    {"trunk", "trunk trunks bark rinde stamm tronc ecorce tronco corteza corteccia 树干 树皮"},
    {"leaf", "leaf blatt feuille hoja foglia"},
    {"water", "water pool pond lake wasser teich eau piscine piscina agua acqua 水 水池 水面"},
    {"snow", "snow schnee neige nieve neve 雪"},
    {"building", "=bldg building buildings context surroundings neighbour neighbours neighbor neighbors nachbar "
                 "nachbarn nachbargebaude nachbargebaeude umgebung gebaude gebaeude batiment batiments voisin edificio "
                 "edificios edifici contesto contexto entorno 建筑 周边建筑"},
    {"fence", "fence fences =fenc zaun zaune zaeune cloture valla recinzione 围栏 围墙"},
    {"vehicle", "=car =cars vehicle vehicles autos voiture voitures coche coches automobile 汽车"},
    {"bitumenroof", "bitumen dachpappe 沥青卷材"},
};

/// Latin letters with marks, U+00C0 to U+017F, as plain letters; a blank stands for what is no letter.
constexpr std::string_view plain_letters = "aaaaaaaceeeeiiiidnooooo ouuuuytsaaaaaaaceeeeiiiidnooooo ouuuuyty"
                                           "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
                                           "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";

/// Number of bytes of the character that begins here, and its code point; bad bytes are passed over one by one.
struct Character {
    char32_t code;
    std::size_t size;
};

Character character_at(std::string_view text, std::size_t at)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
    const unsigned char lead = byte(0);
    const std::size_t size = lead < 0x80   ? 1
                             : lead < 0xC0 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF8 ? 4
                                           : 0;
    if (size == 0 || at + size > text.size())
        return {0xFFFD, 1};
    if (size == 1)
        return {lead, 1};
    char32_t code = lead & (0x7Fu >> size);
    for (std::size_t i = 1; i < size; ++i)
        code = (code << 6) | (byte(i) & 0x3Fu);
    return {code, size};
}

bool is_combining(char32_t c)
{
    return c >= 0x300 && c < 0x370;
}

/// Plain lower-case letters for a Latin letter; empty for what is no Latin letter.
std::string plain(char32_t c)
{
    if (c < 0x80)
        return lowercase_ascii(std::string(1, static_cast<char>(c)));
    if (c == 0xDF || c == 0x1E9E)
        return "ss";
    if (c >= 0xC0 && c - 0xC0 < plain_letters.size() && plain_letters[c - 0xC0] != ' ')
        return std::string(1, plain_letters[c - 0xC0]);
    return {};
}

bool is_capital(char32_t c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 0xC0 && c < 0xDE && c != 0xD7);
}
bool is_latin_letter(char32_t c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= 0x80 && !plain(c).empty());
}

/// Words of the name: split at signs, digits, and where a capital follows a small letter; other scripts are one word
/// each run.
std::vector<std::string> words_of(std::string_view name)
{
    enum class Kind { none, latin, other };
    std::vector<std::string> words;
    Kind open = Kind::none;
    bool small_before = false;
    const auto put = [&](Kind kind, std::string_view letters) {
        if (open != kind)
            words.emplace_back();
        words.back() += letters;
        open = kind;
    };
    for (std::size_t i = 0; i < name.size();) {
        const auto [c, size] = character_at(name, i);
        if (is_latin_letter(c)) {
            if (small_before && is_capital(c))
                open = Kind::none;
            small_before = !is_capital(c);
            put(Kind::latin, plain(c));
        } else if (is_combining(c)) {
            // belongs to the letter before, which is already a plain one
        } else if (c >= 0x2E80 && c != 0xFFFD) {
            put(Kind::other, name.substr(i, size));
            small_before = false;
        } else {
            open = Kind::none;
            small_before = false;
        }
        i += size;
    }
    return words;
}

struct Meaning {
    std::vector<const char*> ideas;
    bool whole = false; ///< never part of a compound
};

struct Dictionary {
    std::unordered_map<std::string, Meaning> meanings;
    std::size_t longest = 0;
};

const Dictionary& dictionary()
{
    static const Dictionary built = [] {
        Dictionary result;
        for (const Idea& idea : ideas)
            for (std::string_view word : split(idea.words)) {
                const bool whole = word[0] == '=';
                word.remove_prefix(whole ? 1 : 0);
                Meaning& meaning = result.meanings[std::string(word)];
                meaning.ideas.push_back(idea.idea);
                meaning.whole = meaning.whole || whole;
                result.longest = std::max(result.longest, word.size());
            }
        return result;
    }();
    return built;
}

bool add_exact(const std::string& word, std::set<std::string>& found, bool in_compound = false)
{
    const auto entry = dictionary().meanings.find(word);
    if (entry == dictionary().meanings.end() || (in_compound && entry->second.whole))
        return false;
    found.insert(entry->second.ideas.begin(), entry->second.ideas.end());
    return true;
}

/// A word of the dictionary needs this many letters to be recognised inside a longer one.
constexpr std::size_t shortest_part = 4;

bool add_without_ending(const std::string& word, std::set<std::string>& found, bool in_compound = false)
{
    for (const char* ending : {"s", "es", "n", "en", "e", "er"}) {
        const std::string_view tail = ending;
        if (word.size() >= shortest_part + tail.size() && word.ends_with(tail) &&
            add_exact(word.substr(0, word.size() - tail.size()), found, in_compound))
            return true;
    }
    return false;
}

/// Compounds such as `stahlbetonwand`: the longest known word at the end, and the longest one at the beginning of what
/// remains.
void add_parts(const std::string& word, std::set<std::string>& found)
{
    for (std::size_t size = word.size() - 1; size >= shortest_part; --size) {
        const std::string tail = word.substr(word.size() - size);
        if (!add_exact(tail, found, true) && !add_without_ending(tail, found, true))
            continue;
        for (std::size_t head = word.size() - size; head >= shortest_part; --head)
            if (add_exact(word.substr(0, head), found, true))
                return;
        return;
    }
    for (std::size_t head = word.size() - 1; head >= shortest_part; --head)
        if (add_exact(word.substr(0, head), found, true))
            return;
}

/// Scripts without blanks: the longest known words from left to right.
void add_run(const std::string& run, std::set<std::string>& found)
{
    for (std::size_t i = 0; i < run.size();) {
        std::size_t used = 0;
        for (std::size_t size = std::min(dictionary().longest, run.size() - i); size > 0 && used == 0; --size)
            if (add_exact(run.substr(i, size), found))
                used = size;
        i += used > 0 ? used : character_at(run, i).size;
    }
}

} // namespace

std::string folded(std::string_view name)
{
    std::string text;
    for (std::size_t i = 0; i < name.size();) {
        const auto [c, size] = character_at(name, i);
        const std::string letters = plain(c);
        if (!letters.empty())
            text += letters;
        else if (!is_combining(c))
            text += name.substr(i, size);
        i += size;
    }
    return text;
}

std::set<std::string> ideas_in(std::string_view name)
{
    // Layer names are short; what is longer is no name, and its beginning says enough.
    constexpr std::size_t longest_read = 512;
    std::set<std::string> found;
    for (const std::string& word : words_of(name.substr(0, longest_read))) {
        if (static_cast<unsigned char>(word[0]) >= 0x80)
            add_run(word, found);
        else if (!add_exact(word, found) && !add_without_ending(word, found) && word.size() > shortest_part)
            add_parts(word, found);
    }
    return found;
}

} // namespace lightwell
