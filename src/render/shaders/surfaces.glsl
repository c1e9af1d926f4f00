// The number of a pixel's surface, in the alpha of the first pass, for shaders/drawn.frag: distinct as far as 8 bits allow.
const float backdrop_number = 0.0, ground_number = 1.0 / 255.0;
float front_number(int cloth) { return float(2 + 2 * (cloth % 64)) / 255.0; }  // the back has the next number
float back_number(int cloth) { return float(3 + 2 * (cloth % 64)) / 255.0; }
float shape_number(int shape) { return float(130 + shape % 126) / 255.0; }
